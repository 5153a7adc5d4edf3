#include "robots/start_check.h"

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

World surface(double half_m) {
  World world;
  world.bounds = {-half_m, half_m, -half_m, half_m};
  return world;
}

void addPillar(World& world, const std::string& name, double x, double y, double radius, HeightSpan heights = {0, 1}) {
  Body body;
  body.shape = Cylinder{radius};
  body.world_from_body = {x, y, 0};
  body.height_m = heights.z_max_m - heights.z_min_m;
  body.center_z_m = (heights.z_min_m + heights.z_max_m) / 2;
  world.objects.push_back({.name = name, .body = body, .line = {7}});
}

RobotStart robot(const std::string& name, int line, double x, double y, double radius, HeightSpan heights = {0, 1}) {
  return {name, {line}, {{x, y}, radius}, heights};
}

Lines faults(const World& world, const std::vector<RobotStart>& robots) {
  ErrorList errors;
  checkStarts(world, robots, "w.xml", errors);
  return errors.errors();
}

TEST(CheckStarts, NamesBothOverlappingRobots) {
  World world = surface(10);
  addPillar(world, "Pillar", 0, 0, 1);
  EXPECT_EQ(faults(world, {robot("A", 20, 1.2, 0, 0.3), robot("B", 21, 1.3, 0.5, 0.3)}),
            (Lines{"w.xml:20: robot 'A' at (1.2, 0) m overlaps the object 'Pillar' of line 7; move one of them",
                   "w.xml:21: robot 'B' at (1.3, 0.5) m overlaps the robot 'A' of line 20; move one of them"}));
}

TEST(CheckStarts, AllowsRobotsToTouch) {
  World world = surface(10);
  addPillar(world, "Pillar", 0, 0, 1);
  EXPECT_EQ(faults(world, {robot("A", 20, 1.5, 0, 0.5), robot("B", 21, 2.5, 0, 0.5), robot("C", 22, 9.5, -9.5, 0.5)}),
            Lines{});
}

/// A map whose cells of 1 m fill [0, 2] × [0, 1], as a wall of 1 m.
WorldMap wall() {
  WorldMap map;
  map.file = "wall.png";
  map.line = {8};
  map.plan.columns = 2;
  map.plan.rows = 1;
  map.plan.cell_m = 1;
  map.plan.occupied = {{0, 0, 1, 1}, {1, 0, 1, 1}};
  return map;
}

TEST(CheckStarts, ReportsAnOverlappedMapOnce) {
  World world = surface(10);
  addPillar(world, "Pillar", 5, 5, 1);
  world.maps = {wall()};
  EXPECT_EQ(
      faults(world, {robot("A", 20, 1, 1.2, 0.3), robot("B", 21, 5, 5, 0.5), robot("C", 22, 1, 0.5, 0.1, {1, 2})}),
      (Lines{"w.xml:20: robot 'A' at (1, 1.2) m overlaps an obstacle of the map 'wall.png' of line 8; move the robot",
             "w.xml:21: robot 'B' at (5, 5) m overlaps the object 'Pillar' of line 7; move one of them"}));
}

TEST(CheckStarts, AllowsRobotsToTouchAMap) {
  World world = surface(10);
  world.maps = {wall()};
  EXPECT_EQ(faults(world, {robot("A", 20, 1, 1.5, 0.5), robot("B", 21, -0.25, 0.5, 0.25)}), Lines{});
}

TEST(CheckStarts, ExplainsThatOnlyTheDiscOfABoxOverlaps) {
  // A box of 1 m × 0.2 m along a wall whose face is 0.2 m away; its disc has a radius of hypot(0.5, 0.1) = 0.510 m.
  World world = surface(10);
  addPillar(world, "Pillar", 0, 1.2, 1);
  RobotStart box = robot("A", 20, 0, 0, std::hypot(0.5, 0.1));
  box.outline = OrientedBox::from({0, 0, 0}, 1, 0.2);
  EXPECT_EQ(faults(world, {box}),
            Lines{"w.xml:20: robot 'A' at (0, 0) m overlaps the object 'Pillar' of line 7 (its box does not, but moves "
                  "are authorised for the disc of 0.510 m radius around it); move one of them"});
  box.outline = OrientedBox::from({0, 0, M_PI / 2}, 1, 0.2);  // now it reaches into the pillar
  EXPECT_EQ(faults(world, {box}),
            Lines{"w.xml:20: robot 'A' at (0, 0) m overlaps the object 'Pillar' of line 7; move one of them"});
}

TEST(CheckStarts, ConsidersHeights) {
  World world = surface(10);
  addPillar(world, "Bridge", 0, 0, 1, {2, 3});
  EXPECT_EQ(faults(world, {robot("A", 20, 0, 0, 0.5), robot("B", 21, 0, 0, 0.5, {1, 2})}), Lines{});
  EXPECT_EQ(faults(world, {robot("A", 20, 0, 0, 0.5, {0, 2.1})}),
            Lines{"w.xml:20: robot 'A' at (0, 0) m overlaps the object 'Bridge' of line 7; move one of them"});
}

TEST(CheckStarts, RequiresTheWholeRobotOnTheSurface) {
  const std::string fault =
      " m stands outside the surface, or reaches over its edge; move it inside, or widen the surface's <size>";
  EXPECT_EQ(
      faults(surface(10), {robot("A", 20, 9.6, 0, 0.5), robot("B", 21, 0, -9.51, 0.5), robot("C", 22, 1e9, 0, 0.5)}),
      (Lines{"w.xml:20: robot 'A' at (9.6, 0)" + fault, "w.xml:21: robot 'B' at (0, -9.51)" + fault,
             "w.xml:22: robot 'C' at (1e+09, 0)" + fault}));
}

TEST(CheckStarts, RequiresTheWholeRobotWithinEveryEdge) {
  const auto is_refused = [](double x, double y) { return !faults(surface(10), {robot("A", 20, x, y, 0.5)}).empty(); };
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_FALSE(is_refused(sign * 9.5, 0)) << sign;
    EXPECT_FALSE(is_refused(0, sign * 9.5)) << sign;
    EXPECT_TRUE(is_refused(sign * 9.51, 0)) << sign;
    EXPECT_TRUE(is_refused(0, sign * 9.51)) << sign;
  }
}

TEST(CheckStarts, AgreesWithTestingEveryPair) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    World world = surface(10);
    for (int i = 0; i < 20; ++i) {
      addPillar(world, std::to_string(i), rng.uniform(-12, 12), rng.uniform(-12, 12), rng.uniform(0.1, 1.5),
                {0, rng.uniform(0.5, 1.5)});
    }
    std::vector<RobotStart> robots;
    for (int i = 0; i < 60; ++i) {
      const double low = rng.uniform(0, 2);
      robots.push_back(
          robot(std::to_string(i), i, rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(0.05, 1), {low, low + 1}));
    }
    std::set<std::string> overlapping;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const Solid solid{robots[i].disc, robots[i].heights};
      for (const auto& object : world.objects) {
        if (overlap(solid, object.body.solid())) overlapping.insert(robots[i].name);
      }
      for (std::size_t j = 0; j < i; ++j) {
        if (overlap(solid, {robots[j].disc, robots[j].heights})) overlapping.insert(robots[i].name);
      }
    }
    std::set<std::string> reported;
    for (const auto& fault : faults(world, robots)) {
      const auto begin = fault.find('\'') + 1;
      reported.insert(fault.substr(begin, fault.find('\'', begin) - begin));
    }
    EXPECT_EQ(reported, overlapping) << "seed " << seed;
  }
}

TEST(CheckStarts, ChecksAHundredThousandRobotsAtOnePosition) {
  const std::vector<RobotStart> robots(100'000, robot("A", 20, 0, 0, 0.5));
  const Lines lines = faults(surface(10), robots);
  ASSERT_EQ(lines.size(), ErrorList::kMaxErrors + 1);
  EXPECT_EQ(lines.back(), "and 98999 more errors");
}

}  // namespace
}  // namespace robosim
