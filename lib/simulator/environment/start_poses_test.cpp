#include "environment/start_poses.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/error_list.h"
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

/// A square of 6 m with a gold pillar of 0.2 m radius in its middle, and discs of 0.25 m radius.
struct GoldRoom {
  explicit GoldRoom(int robots = 1) {
    world = emptyWorld(3);
    addGold(world, 0, 0, 0.2);
    for (int i = 0; i < robots; ++i)
      addDisc(world, fleet, "r" + std::to_string(i), {0.6 * (i / 8) - 2.5, 0.6 * (i % 8) - 2.5, 0});
  }
  void addHeatSensor(double range_m) {
    for (auto& robot : fleet.robots) {
      auto sensors = *robot.info.sensors;
      sensors.emplace_back();
      sensors.back().kind = SensorKind::heat;
      sensors.back().range_max_m = range_m;
      robot.info.sensors = std::make_shared<std::vector<SensorInfo>>(sensors);
    }
  }
  /// The shortest and longest distance of starts of some seeds from the pillar's outline.
  std::pair<double, double> distances() const {
    const RandomStarts random(world, fleet);
    std::pair<double, double> found{1e9, 0};
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      for (const auto& start : random.draw(seed)) {
        const double distance_m = std::hypot(start.x, start.y) - 0.2;
        found = {std::min(found.first, distance_m), std::max(found.second, distance_m)};
      }
    }
    return found;
  }
  World world;
  Fleet fleet;
};

TEST(StartPoses, AreBeyondTheRangeOfTheHeatSensor) {
  GoldRoom room;
  room.addHeatSensor(1.5);
  EXPECT_EQ(RandomStarts(room.world, room.fleet).distance(), 1.5);
  const auto [nearest, farthest] = room.distances();
  EXPECT_GE(nearest, 1.5);
  EXPECT_GT(farthest, 2.5) << "up to the corners, 3.7 m away";
}

TEST(StartPoses, DoNotWinAtOnceWithoutAHeatSensor) {
  GoldRoom room;
  // 0.5 m between the outlines of robot and gold.
  EXPECT_DOUBLE_EQ(RandomStarts(room.world, room.fleet).distance(), 0.5 + 0.25);
  EXPECT_GE(room.distances().first, 0.75);
}

// The places fill a square of 5.5 m. Beyond 3.07 m from its middle there are four corners with a tenth of its area.
TEST(StartPoses, AreInTheFarthestTenthWhereTheHeatSensorReachesFarther) {
  GoldRoom room;
  room.addHeatSensor(10);
  const double distance_m = RandomStarts(room.world, room.fleet).distance();
  EXPECT_NEAR(distance_m, 3.07 - 0.2, 0.1);
  EXPECT_GE(room.distances().first, distance_m);
}

TEST(StartPoses, ComeNearerToTheGoldIfTheRobotsHaveNoRoomElsewhere) {
  GoldRoom room(40);
  room.addHeatSensor(10);
  const auto [nearest, farthest] = room.distances();
  EXPECT_LT(nearest, 2.7) << "the corners have no room for 40";
  EXPECT_GT(nearest, 1.2) << "as far away as possible";
}

TEST(StartPoses, KeepTheDistanceOfTheWorld) {
  GoldRoom room;
  room.addHeatSensor(1.5);
  room.world.start_distance_m = 2.5;
  EXPECT_GE(room.distances().first, 2.5);
  room.world.start_distance_m = 0;
  EXPECT_LT(room.distances().first, 0.75) << "anywhere";
  room.world.start_distance_m = 4;
  try {
    RandomStarts(room.world, room.fleet).draw(1);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(
        error.what(),
        "world 'small': there is not enough space to shuffle 1 robots 4 m away from the gold; use fewer robots, a "
        "shorter distance or a larger world");
  }
}

}  // namespace
}  // namespace robosim
