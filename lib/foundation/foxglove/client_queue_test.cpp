#include "foxglove/client_queue.h"

#include <gtest/gtest.h>

namespace robosim::foxglove {
namespace {

Payload bytes(std::size_t size) { return std::make_shared<const std::vector<std::uint8_t>>(size); }
WebMessagePtr text(const std::string& content) { return std::make_shared<const WebMessage>(WebMessage::text(content)); }

/// Subscription and time of the data in their order; the time alone has the subscription -1.
std::vector<std::pair<int, int>> dataOf(ClientQueue& queue) {
  std::vector<std::pair<int, int>> data;
  while (const auto next = queue.take()) {
    if (!next->control) data.emplace_back(next->payload ? static_cast<int>(next->subscription) : -1, next->time_ns);
  }
  return data;
}
using Data = std::vector<std::pair<int, int>>;

TEST(FoxgloveClientQueue, SendsControlMessagesFirstAndDataInOrder) {
  ClientQueue queue;
  EXPECT_EQ(queue.addData(1, 10, bytes(5)), 0u);
  queue.addTime(20);
  EXPECT_EQ(queue.addData(2, 20, bytes(5)), 0u);
  EXPECT_TRUE(queue.addControl(text("a")));
  EXPECT_EQ(queue.take()->message()->bytes(), "a");
  const auto first = queue.take();
  EXPECT_TRUE(first->message()->isBinary());
  EXPECT_EQ(first->message()->bytes().size(), 1 + 4 + 8 + 5u);
  EXPECT_EQ(dataOf(queue), (Data{{-1, 20}, {2, 20}}));
  EXPECT_TRUE(queue.isEmpty());
  EXPECT_EQ(queue.dataBytes(), 0u);
}

TEST(FoxgloveClientQueue, KeepsTheNewestMessagesOfASubscription) {
  ClientQueue queue;
  queue.addData(2, 0, bytes(1));
  const int count = static_cast<int>(ClientQueue::kMaxOfSubscription);
  std::size_t dropped = 0;
  for (int i = 0; i < count + 3; ++i) dropped += queue.addData(1, static_cast<std::uint64_t>(i), bytes(1));
  EXPECT_EQ(dropped, 3u);
  const Data data = dataOf(queue);
  ASSERT_EQ(data.size(), 1 + ClientQueue::kMaxOfSubscription);
  EXPECT_EQ(data[0], (std::pair{2, 0}));
  EXPECT_EQ(data[1], (std::pair{1, 3}));
  EXPECT_EQ(data.back(), (std::pair{1, count + 2}));
}

TEST(FoxgloveClientQueue, DropsOlderDataOfTheSameSubscriptionBeforeThoseOfOthers) {
  constexpr std::size_t third = ClientQueue::kMaxDataBytes / 3;
  ClientQueue queue;
  queue.addData(1, 1, bytes(third));
  queue.addData(2, 2, bytes(third));
  queue.addData(2, 3, bytes(third));
  EXPECT_EQ(queue.addData(2, 4, bytes(third)), 1u);
  EXPECT_EQ(queue.addData(3, 5, bytes(third)), 1u);  // none of its own: the oldest of all
  EXPECT_EQ(dataOf(queue), (Data{{2, 3}, {2, 4}, {3, 5}}));
}

TEST(FoxgloveClientQueue, KeepsAMessageThatIsLargerThanItsLimitAlone) {
  ClientQueue queue;
  queue.addData(1, 1, bytes(10));
  EXPECT_EQ(queue.addData(2, 2, bytes(ClientQueue::kMaxDataBytes + 1)), 1u);
  EXPECT_EQ(dataOf(queue), (Data{{2, 2}}));
}

TEST(FoxgloveClientQueue, ReplacesMessagesThatANewerOneMakesObsolete) {
  ClientQueue queue;
  queue.addTime(1);
  queue.addData(1, 1, bytes(1), true);
  queue.addTime(2);
  EXPECT_EQ(queue.addData(1, 2, bytes(1), true), 0u);
  EXPECT_EQ(dataOf(queue), (Data{{-1, 2}, {1, 2}}));
}

TEST(FoxgloveClientQueue, DiscardsTheDataOfASubscriptionThatHasEnded) {
  ClientQueue queue;
  queue.addData(1, 1, bytes(1));
  queue.addData(2, 2, bytes(1));
  queue.addData(1, 3, bytes(1));
  queue.discard(1);
  queue.discard(7);
  EXPECT_EQ(dataOf(queue), (Data{{2, 2}}));
}

TEST(FoxgloveClientQueue, RefusesControlMessagesBeyondItsLimits) {
  ClientQueue by_count;
  for (std::size_t i = 0; i < ClientQueue::kMaxControl; ++i) ASSERT_TRUE(by_count.addControl(text("a")));
  EXPECT_FALSE(by_count.addControl(text("a")));
  ClientQueue by_bytes;
  EXPECT_TRUE(by_bytes.addControl(text(std::string(ClientQueue::kMaxControlBytes, 'a'))));
  EXPECT_FALSE(by_bytes.addControl(text("a")));
  EXPECT_TRUE(by_bytes.take());
  EXPECT_TRUE(by_bytes.addControl(text("a")));
}

}  // namespace
}  // namespace robosim::foxglove
