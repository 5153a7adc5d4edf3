#include "robots/start_places.h"

#include <cmath>

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

/// The start of the next disc of 0.2 m radius in a world with such discs; 1.4 m between centers leave 1 m between them.
std::optional<TPose2D> besideIn(const World& world) { return findStartBeside(world, "w.xml", kDiscTypes, "disc"); }

void expectStart(const std::optional<TPose2D>& start, double x, double y, double phi) {
  ASSERT_TRUE(start);
  EXPECT_NEAR(start->x, x, 1e-12);
  EXPECT_NEAR(start->y, y, 1e-12);
  EXPECT_EQ(start->phi, phi);
}

World worldWithDiscs(const Bounds2D& bounds, const std::vector<TPose2D>& starts) {
  World world = worldWith(starts, starts.size());
  world.maps.clear();
  world.bounds = bounds;
  return world;
}

TEST(StartPlaces, BesideRobotsAreToTheLeftToTheRightAndBehindWithAMetreBetween) {
  const Bounds2D bounds{-4, 4, -4, 4};
  std::vector<TPose2D> discs{{0, 0, 0}};
  expectStart(besideIn(worldWithDiscs(bounds, discs)), 0, 1.4, 0);
  discs.emplace_back(0, 1.4, 0);
  expectStart(besideIn(worldWithDiscs(bounds, discs)), 0, -1.4, 0);
  discs.emplace_back(0, -1.4, 0);
  expectStart(besideIn(worldWithDiscs(bounds, discs)), 0, 2.8, 0);           // to the left of the second one
  expectStart(besideIn(worldWithDiscs({-4, 4, -2, 2}, discs)), -1.4, 0, 0);  // the row is full
}

TEST(StartPlaces, BesideRobotsDependOnTheirHeading) {
  expectStart(besideIn(worldWithDiscs({-4, 4, -4, 4}, {{0, 0, M_PI_2}})), -1.4, 0, M_PI_2);
}

// In a corridor of 1 m along the x axis, only behind; with a wall behind it, only ahead, with the same clearance.
TEST(StartPlaces, BesideRobotsAreRatherBehindThanAhead) {
  expectStart(besideIn(worldWithDiscs({-4, 4, -0.5, 0.5}, {{0, 0, 0}})), -1.4, 0, 0);
  // At x = -1.4 it would cross the edge at -1.58; at the cell (-1.33, 0.25) it is 1.404 m from the other.
  expectStart(besideIn(worldWithDiscs({-1.58, 4, -0.5, 0.5}, {{0, -0.2, 0}})), -1.33, 0.25, 0);
  const auto ahead = besideIn(worldWithDiscs({-1, 4, -0.5, 0.5}, {{0, 0, 0}}));
  ASSERT_TRUE(ahead);
  EXPECT_GE(ahead->x, 1.37);
  EXPECT_LT(ahead->x, 1.7) << "the nearest place";
}

TEST(StartPlaces, BesideRobotsAreCloserWhereThereIsLessRoom) {
  const auto start = besideIn(worldWithDiscs({-0.5, 1.2, -0.5, 0.5}, {{-0.2, 0, 0}}));
  ASSERT_TRUE(start);
  EXPECT_GT(start->x, 0.1);
  EXPECT_EQ(besideIn(worldWithDiscs({-0.25, 0.25, -0.25, 0.25}, {{0, 0, 0}})), std::nullopt);
}

}  // namespace
}  // namespace robosim
