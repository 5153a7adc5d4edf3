#include "distributed/near_robots.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

TEST(NearRobots, RenewsAreasBeforeRobotsApproachByHalfTheReach) {
  const Bounds2D surface{0, 100, 0, 100};
  const NearRobots near(surface, 600, {.reach_m = 8, .step_m = 0.1});
  EXPECT_EQ(near.steps(), 20u);  // 20 steps towards each other, of 0.1 m each: 4 m
  EXPECT_NEAR(near.reach(), 8 + 4, 1e-9);
  EXPECT_EQ(NearRobots(surface, 600, {.reach_m = 8, .step_m = 5}).steps(), 1u);
  EXPECT_NEAR(NearRobots(surface, 600, {.reach_m = 8, .step_m = 5}).reach(), 8 + 10, 1e-9);
  EXPECT_EQ(NearRobots(surface, 600, {.reach_m = 8, .step_m = 0}).steps(), 100u);
}

TEST(NearRobots, AreNeededByTheRanksOfRobotsThatTheyMayAffect) {
  const Bounds2D surface{0, 100, 0, 100};
  constexpr std::size_t kRobots = 600, kRanks = 3;
  NearRobots near(surface, 600, {.reach_m = 3, .step_m = 0.2});
  const RankShares shares = RankShares::of(kRobots, kRanks, false);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    std::vector<TPose2D> poses;  // in a strip per rank
    for (std::size_t rank = 0; rank < kRanks; ++rank) {
      for (std::size_t i = shares.work[rank].begin; i < shares.work[rank].end; ++i)
        poses.emplace_back(rng.uniform(0, 33) + 33 * static_cast<double>(rank), rng.uniform(0, 100), 0);
    }
    std::vector<std::string> areas;
    for (const RobotRange work : shares.work) areas.push_back(near.areaOf(poses, work));
    for (std::size_t own = 0; own < kRanks; ++own) {
      const auto needed = near.neededBy(poses, shares.work[own], areas, shares, own, false);
      EXPECT_TRUE(needed[own].empty());
      for (std::size_t rank = 0; rank < kRanks; ++rank) {
        if (rank == own) continue;
        EXPECT_TRUE(std::is_sorted(needed[rank].begin(), needed[rank].end()));
        EXPECT_LT(needed[rank].size(), (shares.work[own].end - shares.work[own].begin) / 2) << "others are far away";
        for (std::size_t i = shares.work[own].begin; i < shares.work[own].end; ++i) {
          double nearest_m = 1e9;
          for (std::size_t k = shares.work[rank].begin; k < shares.work[rank].end; ++k)
            nearest_m = std::min(nearest_m, std::hypot(poses[i].x - poses[k].x, poses[i].y - poses[k].y));
          if (nearest_m > near.reach()) continue;
          EXPECT_TRUE(std::binary_search(needed[rank].begin(), needed[rank].end(), static_cast<std::uint32_t>(i)));
        }
      }
    }
  }
}

TEST(NearRobots, AreTwoOrThreeRowsAtABorderInAWorldOfAMillionRobots) {
  // Rows 4 m apart, and robots within 5.4 + 2.7 m: two rows, and a third one if it is in the cell, of 4.05 m, in which
  // 8.1 m end, as it rarely is. Each row has one robot here.
  constexpr std::size_t kRows = 1'000;
  NearRobots near({0, 4.0 * kRows, 0, 4.0 * kRows}, kRows * kRows, {.reach_m = 5.4, .step_m = 0.071});
  ASSERT_NEAR(near.reach(), 8.1, 0.01);
  std::vector<TPose2D> poses;
  for (std::size_t i = 0; i < kRows; ++i) poses.emplace_back(2000, 4.0 * static_cast<double>(i) + 2, 0);
  std::size_t rows = 0, borders = 0;
  for (std::size_t border = 100; border <= 900; border += 10, ++borders) {
    RankShares shares = RankShares::of(kRows, 2, false);
    shares.home = shares.digested = shares.work = {{0, border}, {border, kRows}};
    const std::vector<std::string> areas{near.areaOf(poses, shares.work[0]), near.areaOf(poses, shares.work[1])};
    const auto needed = near.neededBy(poses, shares.work[1], areas, shares, 1, false);
    EXPECT_GE(needed[0].size(), 2u);
    EXPECT_LE(needed[0].size(), 3u);
    rows += needed[0].size();
  }
  EXPECT_LT(static_cast<double>(rows) / static_cast<double>(borders), 2.2);
}

TEST(NearRobots, AreNeededByTheRankThatKeepsTheirReadings) {
  const Bounds2D surface{0, 100, 0, 100};
  NearRobots near(surface, 600, {.reach_m = 3, .step_m = 0.2});
  // The sensors of ten robots have moved from rank 0 to rank 1, which sends the readings.
  RankShares shares = RankShares::of(600, 2, false);
  ASSERT_EQ(shares.home[0], (RobotRange{0, 256}));
  shares.work = {{0, 246}, {246, 600}};
  std::vector<TPose2D> poses(600);
  for (std::size_t i = 0; i < 246; ++i) poses[i] = {5, 5, 0};
  for (std::size_t i = 246; i < 600; ++i) poses[i] = {95, 95, 0};
  std::vector<std::string> areas;
  for (const RobotRange work : shares.work) areas.push_back(near.areaOf(poses, work));
  EXPECT_EQ(near.neededBy(poses, shares.work[1], areas, shares, 1, false)[0], listOf({246, 256}));
  EXPECT_EQ(near.neededBy(poses, shares.work[1], areas, shares, 1, true)[0], listOf({246, 600}));
}

}  // namespace
}  // namespace robosim
