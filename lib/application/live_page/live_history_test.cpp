#include "live_page/live_history.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Kind = LiveItemKind;

LiveItem moment(int number, std::size_t bytes = 0) {
  return {std::to_string(number) + std::string(bytes, ' '), Kind::moment};
}
/// All that a page receives that is opened now.
std::string wholeOf(const LiveHistory& history) {
  std::string items;
  std::uint64_t number = 0;
  while (const auto part = history.after(number, false)) {
    items += part->items() + ",";
    number = part->up_to;
  }
  return items;
}

TEST(LiveHistory, ReturnsTheItemsAfterANumber) {
  LiveHistory history;
  history.add({"\"objects\"", Kind::objects});
  history.add(moment(1));
  history.add(moment(2));
  EXPECT_EQ(history.last(), 3U);
  const auto all = history.after(0, false);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->items(), "\"objects\",1,2");
  EXPECT_EQ(all->up_to, 3U);
  EXPECT_EQ(history.after(2, false)->items(), "2");
  EXPECT_FALSE(history.after(3, false));
}

TEST(LiveHistory, KeepsEverySecondMomentWhenThereAreTooMany) {
  LiveHistory history;
  for (int i = 0; i <= static_cast<int>(LiveHistory::kMaxMoments); ++i) history.add(moment(i));
  EXPECT_EQ(history.moments(), LiveHistory::kMaxMoments / 2 + 1);
  const auto part = history.after(0, false);
  ASSERT_TRUE(part);
  EXPECT_TRUE(part->items().starts_with("0,2,4,6,"));
  EXPECT_TRUE(part->items().ends_with(",2998,3000"));
}

TEST(LiveHistory, KeepsItsBytesWithinTheBounds) {
  LiveHistory history;
  for (int i = 0; i < 300; ++i) {
    history.add(moment(i, 200'000));
    history.add({std::string(30'000, ' '), Kind::event});
    history.add({std::string(20'000, ' '), Kind::objects});
    ASSERT_LE(history.bytes(), LiveHistory::kMaxMoments_bytes + LiveHistory::kMaxPast_bytes + 20'000);
  }
  // The newest is there.
  EXPECT_TRUE(history.after(history.last() - 3, false)->items().starts_with("299 "));
}

TEST(LiveHistory, KeepsTheObjectsAndTheRobotsThatWereAddedWhateverTheNumberOfEvents) {
  LiveHistory history;
  history.add({"\"objects\"", Kind::objects});
  history.add({"\"robots\"", Kind::robots});
  history.add({"\"first event\"", Kind::event});
  for (int i = 0; i < 50; ++i) history.add({std::string(100'000, ' '), Kind::event});
  const std::string items = wholeOf(history);
  EXPECT_TRUE(items.starts_with("\"objects\",\"robots\", "));
  EXPECT_EQ(items.find("first event"), std::string::npos);
}

TEST(LiveHistory, KeepsTheNewestListOfObjectsWhateverItsSize) {
  LiveHistory history;
  for (const char* const name : {"\"first\"", "\"second\""}) {
    history.add({name + std::string(LiveHistory::kMaxPast_bytes, ' '), Kind::objects});
  }
  history.add({"\"event\"", Kind::event});
  const std::string items = wholeOf(history);
  EXPECT_TRUE(items.starts_with("\"second\""));
  EXPECT_TRUE(items.ends_with("\"event\","));
}

TEST(LiveHistory, LeavesOutAllMomentsButTheNewestForAPageThatIsBehind) {
  LiveHistory history;
  for (int i = 0; i < 20; ++i) history.add(moment(i));
  history.add({"\"events\"", Kind::event});
  for (int i = 20; i <= static_cast<int>(LiveHistory::kMaxBehind); ++i) history.add(moment(i));
  const auto present = history.after(0, true);
  ASSERT_TRUE(present);
  EXPECT_EQ(present->items(), "\"events\",50");
  EXPECT_EQ(present->left_out, LiveHistory::kMaxBehind);
  EXPECT_EQ(history.after(1, true)->left_out, 0U) << "fifty are not too many";
}

TEST(LiveHistory, DividesALongHistoryIntoParts) {
  LiveHistory history;
  for (int i = 0; i < 10; ++i) history.add(moment(i, 100'000));
  std::uint64_t number = 0;
  int parts = 0;
  while (const auto part = history.after(number, false)) {
    EXPECT_LT(part->items().size(), LiveHistory::kPart_bytes + 100'010);
    number = part->up_to;
    ++parts;
  }
  EXPECT_EQ(number, 10U);
  EXPECT_EQ(parts, 4);
}

TEST(LiveHistory, ContinuesItsNumbersAfterItWasCleared) {
  LiveHistory history;
  history.add(moment(1));
  history.clear();
  EXPECT_FALSE(history.after(0, false));
  history.add(moment(2));
  EXPECT_EQ(history.after(1, false)->items(), "2");
}

}  // namespace
}  // namespace robosim
