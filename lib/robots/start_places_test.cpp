#include "robots/start_places.h"

#include <gtest/gtest.h>

#include "world/map_reader.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;
using mrpt::math::TPose2D;

/// Robot type of 0.2 m radius.
const RobotTypes kDiscTypes{
    {"disc",
     {"disc.xml",
      "<robot name='disc'><body radius_m='0.2' height_m='0.5'/><limits speed_max_mps='1' accel_mps2='1' "
      "decel_mps2='1' turn_max_degps='90' turn_accel_degps2='90'/><sensors><odometry/></sensors></robot>"}}};

/// A map of 4 m × 3 m with these starts and a robot for each of the first `robots` of them, as read from `robots`
/// robots without a place.
World worldWith(const std::vector<TPose2D>& starts, std::size_t robots = 1) {
  World world;
  world.bounds = {0, 4, 0, 3};
  WorldMap map;
  map.file = "a.map";
  map.plan.starts = starts;
  world.maps.push_back(map);
  for (std::size_t i = 0; i < robots; ++i) {
    RobotPlacement robot;
    robot.name = "R" + std::to_string(i + 1);
    robot.model = "disc";
    robot.world_from_robot = starts[i];
    world.robots.push_back(robot);
  }
  return world;
}

struct Placed : LoadedWorld {
  Lines warnings;
};

Placed placedAtStarts(World world, const std::string& file = "a.map") {
  ErrorList errors;
  Placed loaded;
  static_cast<LoadedWorld&>(loaded) = placedWorld(std::move(world), file, kDiscTypes, {}, 1, errors, &loaded.warnings);
  errors.throwIfAny();
  return loaded;
}

std::vector<TPose2D> starts(const LoadedWorld& loaded) {
  std::vector<TPose2D> poses;
  for (const auto& robot : loaded.fleet.robots) poses.push_back(robot.world_from_start);
  return poses;
}

TEST(StartPlaces, AreTheFirstStartOfTheMapIfItIsFree) {
  const Placed loaded = placedAtStarts(worldWith({{1, 1, 0.5}, {2, 1.5, 0}}));
  EXPECT_EQ(starts(loaded), std::vector{TPose2D(1, 1, 0.5)});
  EXPECT_EQ(loaded.warnings, Lines());
}

TEST(StartPlaces, AreTheNextFreeStartOfTheMap) {
  // 0.1 m from the edge, which a disc of 0.2 m reaches over.
  const Placed loaded = placedAtStarts(worldWith({{0.1, 0.1, 0.5}, {2, 1.5, 0.25}}));
  EXPECT_EQ(starts(loaded), std::vector{TPose2D(2, 1.5, 0.25)});
  EXPECT_EQ(loaded.warnings,
            Lines{"a.map: robot 'R1' stands at (2, 1.5) m, the next free start: the map's start (0.1, 0.1) m is not "
                  "free"});
}

TEST(StartPlaces, AreTheFreePlaceNearestToTheFirstStart) {
  // Places lie in the middle of cells of 0.1 m, half of the radius: 0.25 m is the first that the disc fits at.
  const Placed loaded = placedAtStarts(worldWith({{0.1, 0.1, 0.5}}));
  ASSERT_EQ(loaded.fleet.robots.size(), 1u);
  EXPECT_NEAR(starts(loaded)[0].x, 0.25, 1e-9);
  EXPECT_NEAR(starts(loaded)[0].y, 0.25, 1e-9);
  EXPECT_EQ(starts(loaded)[0].phi, 0.5);
  EXPECT_EQ(loaded.warnings,
            Lines{"a.map: robot 'R1' stands at (0.25, 0.25) m, the nearest free place: the map's start (0.1, 0.1) m is "
                  "not free"});
}

TEST(StartPlaces, AreDistinctForRobotsOfAWorld) {
  const Placed loaded = placedAtStarts(worldWith({{0.1, 0.1, 0}, {2, 1.5, 0}}, 2), "a.xml");
  ASSERT_EQ(loaded.fleet.robots.size(), 2u);
  EXPECT_EQ(starts(loaded)[0], TPose2D(2, 1.5, 0));
  EXPECT_NEAR(starts(loaded)[1].x, 1.95, 0.5) << "beside the first, whose start it is";
  EXPECT_EQ(loaded.warnings.size(), 2u);
}

TEST(StartPlaces, LeaveTheRobotOfAMapWithoutRoomOut) {
  World tiny = worldWith({{0.1, 0.1, 0}});
  tiny.bounds = {0, 0.3, 0, 0.3};
  const Placed loaded = placedAtStarts(tiny);
  EXPECT_TRUE(loaded.fleet.robots.empty());
  EXPECT_EQ(loaded.warnings, Lines{"a.map: robot 'R1' is left out: the map's start (0.1, 0.1) m is not "
                                   "free, and there is no room elsewhere"});
  EXPECT_THROW(placedAtStarts(tiny, "a.xml"), ConfigError) << "a world file asks for the robot";
}

TEST(StartPlaces, DoNotMoveRobotsThatHaveAPlace) {
  World world = worldWith({{0.1, 0.1, 0}});
  world.maps.front().plan.starts = {{2, 1.5, 0}};
  EXPECT_THROW(placedAtStarts(world), ConfigError);
}

}  // namespace
}  // namespace robosim
