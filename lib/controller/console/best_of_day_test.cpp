#include "console/best_of_day.h"

#include <gtest/gtest.h>

#include "base/error_list.h"

namespace robosim {
namespace {

std::string namesOf(const BestOfDay& best) {
  std::string names;
  for (const auto& result : best.results()) names += result.name;
  return names;
}

TEST(BestOfDay, RanksByTimeAndKeepsTheEarlierOfEqualTimesFirst) {
  BestOfDay best;
  best.setDay("2026-11-28");
  EXPECT_EQ(best.add({.name = "A", .time_s = 50}), 1u);
  EXPECT_EQ(best.add({.name = "B", .time_s = 40}), 1u);
  EXPECT_EQ(best.add({.name = "C", .time_s = 50}), 3u);
  EXPECT_EQ(best.add({.name = "D", .time_s = 45}), 2u);
  EXPECT_EQ(namesOf(best), "BDAC");
}

TEST(BestOfDay, BeginsANewListWithTheDay) {
  BestOfDay best;
  best.setDay("2026-11-28");
  best.add({.name = "A", .time_s = 50});
  best.setDay("2026-11-28");
  EXPECT_EQ(namesOf(best), "A");
  best.setDay("2026-11-29");
  EXPECT_EQ(namesOf(best), "");
}

TEST(BestOfDay, OrdersTeamsByWinsThenByTheirBestTime) {
  BestOfDay best;
  best.add({.name = "A", .team = "Red", .time_s = 50});
  best.add({.name = "B", .team = "Blue", .time_s = 60});
  best.add({.name = "C", .team = "Blue", .time_s = 70});
  best.add({.name = "D", .team = "Green", .time_s = 40});
  best.add({.name = "E", .time_s = 10});
  const auto standings = best.standings();
  ASSERT_EQ(standings.size(), 3u);
  EXPECT_EQ(standings[0].team, "Blue");
  EXPECT_EQ(standings[0].wins, 2u);
  EXPECT_EQ(standings[0].best_s, 60);
  EXPECT_EQ(standings[1].team, "Green");
  EXPECT_EQ(standings[2].team, "Red");
}

TEST(BestOfDay, KeepsTheBestThousand) {
  BestOfDay best;
  for (int i = 0; i < 1001; ++i) best.add({.name = "A", .time_s = 2000.0 - i});
  ASSERT_EQ(best.results().size(), BestOfDay::kMaxResults);
  EXPECT_EQ(best.results().back().time_s, 1999);
}

TEST(BestOfDay, ContinuesFromItsFile) {
  BestOfDay best;
  best.setDay("2026-11-28");
  best.add({.name = "<b>\"Jürgen\"", .team = "Red", .time_s = 41.25, .distance_m = 12.5});
  best.add({.name = "B", .time_s = 60});
  const auto read = BestOfDay::parse(best.text(), "today.json");
  EXPECT_EQ(read.text(), best.text());
  ASSERT_EQ(read.results().size(), 2u);
  EXPECT_EQ(read.results()[0].name, "<b>\"Jürgen\"");
  EXPECT_EQ(read.results()[0].distance_m, 12.5);
  EXPECT_EQ(read.results()[1].distance_m, std::nullopt);
}

TEST(BestOfDay, RefusesADamagedFile) {
  for (const char* text : {"", "[]", "{}", R"({"day":"2026-11-28"})", R"({"day":"d","results":[{"name":"A"}]})",
                           R"({"day":"d","results":[{"name":"A","team":"","time_s":-1,"distance_m":null}]})",
                           R"({"day":"d","results":[{"name":"A","team":"","time_s":"1","distance_m":null}]})",
                           R"({"day":1,"results":[]})"}) {
    try {
      BestOfDay::parse(text, "today.json");
      ADD_FAILURE() << text;
    } catch (const ConfigError& error) {
      EXPECT_STREQ(error.what(),
                   "today.json: not a list of results of the day, or damaged; delete the file, or select another");
    }
  }
}

}  // namespace
}  // namespace robosim
