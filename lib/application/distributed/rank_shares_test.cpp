#include "distributed/rank_shares.h"

#include <numeric>

#include <gtest/gtest.h>

namespace robosim {
namespace {

void expectPartition(const std::vector<RobotRange>& ranges, std::size_t robots) {
  std::size_t end = 0;
  for (const RobotRange& range : ranges) {
    EXPECT_EQ(range.begin, end);
    EXPECT_GE(range.end, range.begin);
    end = range.end;
  }
  EXPECT_EQ(end, robots);
}

TEST(RankShares, DivideTheRobotsAndTheChunksOfTheDigest) {
  for (const std::size_t robots : {1, 2, 7, 255, 256, 257, 1000, 5000, 100'000}) {
    for (const int ranks : {1, 2, 3, 8, 64}) {
      const RankShares shares = RankShares::of(robots, ranks, false);
      expectPartition(shares.home, robots);
      EXPECT_EQ(shares.work, shares.home);
      std::size_t digested = 0;
      for (std::size_t rank = 0; rank < shares.ranks(); ++rank) {
        const RobotRange range = shares.digested[rank];
        if (range.empty()) continue;
        EXPECT_EQ(range.begin, digested);
        EXPECT_EQ(range.begin % 256, 0u);
        digested = range.end;
        for (const RobotRange part : {range, shares.home[rank], shares.work[rank]}) {
          EXPECT_EQ(hull(shares.kept(rank), part), shares.kept(rank));
        }
      }
      EXPECT_EQ(digested, robots);
    }
  }
}

TEST(RankShares, OfManyRobotsNeedNoReadingsOfOtherRanks) {
  const RankShares shares = RankShares::of(100'000, 8, false);
  for (std::size_t rank = 0; rank < shares.ranks(); ++rank) {
    EXPECT_EQ(shares.digested[rank], shares.home[rank]);
    EXPECT_EQ(shares.needed(rank), shares.home[rank]);
    EXPECT_NEAR(static_cast<double>(shares.home[rank].end - shares.home[rank].begin), 12'500, 256);
  }
  EXPECT_EQ(RankShares::of(100'000, 8, true).needed(0), (RobotRange{0, 100'000}));
}

TEST(RankShares, GiveAddedRobotsToTheLastRank) {
  // One chunk of the digest, which is the first rank's; then a second.
  RankShares few = RankShares::of(5, 2, false);
  few.addRobots(300);
  EXPECT_EQ(few.home, (std::vector<RobotRange>{{0, 2}, {2, 300}}));
  EXPECT_EQ(few.work, few.home);
  EXPECT_EQ(few.digested, (std::vector<RobotRange>{{0, 300}, {}}));
  EXPECT_EQ(few.kept(0), (RobotRange{0, 300}));
  // A chunk of each rank.
  RankShares many = RankShares::of(512, 2, true);
  many.addRobots(513);
  EXPECT_EQ(many.home, (std::vector<RobotRange>{{0, 256}, {256, 513}}));
  EXPECT_EQ(many.digested, many.home);
  EXPECT_EQ(many.needed(0), (RobotRange{0, 513}));
  // Fewer robots than ranks.
  RankShares one = RankShares::of(1, 3, false);
  one.addRobots(2);
  EXPECT_EQ(one.home, (std::vector<RobotRange>{{}, {}, {0, 2}}));
  EXPECT_EQ(one.digested, one.home);
}

TEST(BalancedWork, StaysWhenAllRanksAreBusyAboutEquallyLong) {
  const std::vector<RobotRange> work{{0, 50}, {50, 100}};
  EXPECT_EQ(balancedWork(work, {{1.0, 0.1}, {1.04, 0.1}}), work);
  EXPECT_EQ(balancedWork(work, {{}, {}}), work);
  EXPECT_EQ(balancedWork(work, {{0, 3}, {0, 1}}), work);
}

TEST(BalancedWork, MovesHalfWayToEqualTimes) {
  // A robot of rank 0 takes three times as long: equal times are 4 s, those of two thirds of its robots.
  const std::vector<RobotRange> work{{0, 600}, {600, 1200}};
  EXPECT_EQ(balancedWork(work, {{6, 0}, {2, 0}}), (std::vector<RobotRange>{{0, 500}, {500, 1200}}));
  // Controllers, which do not move, take 4 s on rank 1: rank 0 gets all sensors, at last.
  EXPECT_EQ(balancedWork(work, {{2, 0}, {2, 4}}), (std::vector<RobotRange>{{0, 900}, {900, 1200}}));
}

TEST(BalancedWork, ApproachesEqualTimesForAnyCostOfRobots) {
  constexpr std::size_t kRobots = 4000;
  std::vector<double> cost_s;  // robots in the middle take long
  for (std::size_t i = 0; i < kRobots; ++i) cost_s.push_back(i > 1500 && i < 1900 ? 20 : 1);
  auto work = RankShares::of(kRobots, 5, false).work;
  const auto busyOf = [&] {
    std::vector<BusyTime> busy;
    for (const RobotRange& range : work) {
      busy.push_back({std::accumulate(cost_s.begin() + static_cast<std::ptrdiff_t>(range.begin),
                                      cost_s.begin() + static_cast<std::ptrdiff_t>(range.end), 0.0),
                      100});
    }
    return busy;
  };
  for (int i = 0; i < 40; ++i) {
    work = balancedWork(work, busyOf());
    expectPartition(work, kRobots);
  }
  double longest_s = 0, sum_s = 0;
  for (const BusyTime& time : busyOf()) {
    longest_s = std::max(longest_s, time.work_s + time.other_s);
    sum_s += time.work_s + time.other_s;
  }
  EXPECT_LT(longest_s, 1.06 * sum_s / 5);
}

}  // namespace
}  // namespace robosim
