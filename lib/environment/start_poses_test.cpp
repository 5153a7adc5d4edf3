#include "environment/start_poses.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "environment/testing/small_world.h"

namespace robosim {
namespace {

TEST(StartPoses, KeepShuffledRobotsApartAndOnTheSurface) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World empty = emptyWorld(1.5);
    World world = empty;
    Fleet fleet;
    for (int i = 0; i < 8; ++i) addDisc(world, fleet, "r" + std::to_string(i), {0.6 * (i % 4) - 0.9, 0.6 * (i / 4), 0});
    shuffleStartPoses(empty, fleet, seed);
    for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
      const auto& a = fleet.robots[i].world_from_start;
      EXPECT_LE(std::max(std::abs(a.x), std::abs(a.y)), 1.25) << "seed " << seed << ", robot " << i;
      for (std::size_t k = 0; k < i; ++k) {
        const auto& b = fleet.robots[k].world_from_start;
        EXPECT_GT(std::hypot(a.x - b.x, a.y - b.y), 0.5) << "seed " << seed << ", robots " << k << " and " << i;
      }
    }
  }
}

}  // namespace
}  // namespace robosim
