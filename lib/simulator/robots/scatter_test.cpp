#include "robots/scatter.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "robots/fleet.h"
#include "robots/world_source.h"
#include "world/world_file.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

/// A pillar of this radius, 1 m high, on the ground.
Body pillar(double radius_m) {
  Body body;
  body.shape = Cylinder{radius_m};
  body.center_z_m = 0.5;
  body.height_m = 1;
  return body;
}

/// An empty square of 10 m × 10 m around the origin.
World square() {
  World world;
  world.bounds = {-5, 5, -5, 5};
  return world;
}

Scatter pillars(int count, double radius_m, ScatterPattern pattern) {
  Scatter scatter;
  scatter.count = count;
  scatter.pattern = pattern;
  scatter.copied = WorldObject{.name = "Pillar", .body = pillar(radius_m), .line = {}};
  scatter.line = {3};
  return scatter;
}

RobotPlacement robotOf(const std::string& model, const std::string& name, int line) {
  RobotPlacement robot;
  robot.name = name;
  robot.model = model;
  robot.line.number = line;
  return robot;
}

Lines place(World& world, std::uint64_t seed = 1) {
  ErrorList errors;
  placeScattered(world, "w.xml", robotTypesIn({ROBOSIM_SOURCE_DIR "/worlds/robots"}), seed, errors);
  return errors.errors();
}

World placed(World world, std::uint64_t seed = 1) {
  EXPECT_EQ(place(world, seed), Lines{});
  return world;
}

TEST(Scatter, GridPlacesFourPillarsInTheCorners) {
  World world = square();
  world.scatters = {pillars(4, 0.5, ScatterPattern::grid)};
  world = placed(world);
  ASSERT_EQ(world.objects.size(), 4u);
  const double expected[][2] = {{-4.5, -4.5}, {4.5, -4.5}, {-4.5, 4.5}, {4.5, 4.5}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(world.objects[i].body.world_from_body.x, expected[i][0], 1e-5);
    EXPECT_NEAR(world.objects[i].body.world_from_body.y, expected[i][1], 1e-5);
  }
  EXPECT_TRUE(world.scatters.empty());
}

TEST(Scatter, GridMovesTogetherWhereAPlaceIsTaken) {
  World world = square();
  world.objects.push_back({.name = "First", .body = pillar(0.5), .line = {}});
  world.objects.back().body.world_from_body = {4.5, 4.5, 0};
  world.scatters = {pillars(4, 0.5, ScatterPattern::grid)};
  EXPECT_EQ(placed(world).objects.size(), 5u);
}

TEST(Scatter, RingPlacesFourPillarsOnTheAxes) {
  World world = square();
  Scatter ring = pillars(4, 0.5, ScatterPattern::ring);
  ring.ring_center = {1, 0};
  ring.ring_radius_m = 3;
  ring.direction_rad = 0.25;
  world.scatters = {ring};
  world = placed(world);
  ASSERT_EQ(world.objects.size(), 4u);
  const double expected[][2] = {{4, 0}, {1, 3}, {-2, 0}, {1, -3}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(world.objects[i].body.world_from_body.x, expected[i][0], 1e-12);
    EXPECT_NEAR(world.objects[i].body.world_from_body.y, expected[i][1], 1e-12);
    EXPECT_EQ(world.objects[i].body.world_from_body.phi, 0.25);
  }
}

TEST(Scatter, NumbersTheNames) {
  World world = square();
  world.scatters = {pillars(2, 0.5, ScatterPattern::uniform)};
  world = placed(world);
  EXPECT_EQ(world.objects[0].name, "Pillar1");
  EXPECT_EQ(world.objects[1].name, "Pillar2");
}

TEST(Scatter, LinksRobotsToARing) {
  World world = square();
  Scatter robots;
  robots.count = 3;
  robots.copied = robotOf("scout", "Scout", 0);
  robots.has_neighbour_ring = true;
  world.scatters = {robots};
  world = placed(world);
  ASSERT_EQ(world.robots.size(), 3u);
  for (const auto& [i, neighbour] : {std::pair{0u, "Scout2"}, {1u, "Scout3"}, {2u, "Scout1"}}) {
    EXPECT_EQ(world.robots[i].neighbour, neighbour);
  }
}

TEST(Scatter, FreePlacesAvoidClosedPocketsAndOtherAreas) {
  // A wall at x = 0 divides the square; its larger part in the area is on the right.
  World world = square();
  Body wall;
  wall.shape = Cube{0.2, 10};
  wall.center_z_m = 0.5;
  wall.height_m = 1;
  world.objects.push_back({.name = "Wall", .body = wall, .line = {}});
  Scatter free = pillars(20, 0.2, ScatterPattern::free);
  free.area = Bounds2D{-2, 5, -5, 5};
  world.scatters = {free};
  world = placed(world);
  ASSERT_EQ(world.objects.size(), 21u);
  for (std::size_t i = 1; i < 21; ++i) EXPECT_GE(world.objects[i].body.world_from_body.x, 0.3);
}

TEST(Scatter, DependsOnTheSeedOnly) {
  World world = square();
  world.scatters = {pillars(10, 0.3, ScatterPattern::uniform)};
  EXPECT_EQ(placed(world, 7), placed(world, 7));
  EXPECT_NE(placed(world, 7), placed(world, 8));
}

TEST(Scatter, ReportsHowManyThereIsRoomFor) {
  // A disc of 2 m has its centre within 1 m of the centre of a square of 6 m: two of them would be 4 m apart.
  World world;
  world.bounds = {-3, 3, -3, 3};
  for (const auto pattern : {ScatterPattern::uniform, ScatterPattern::free, ScatterPattern::grid}) {
    world.scatters = {pillars(5, 2, pattern)};
    EXPECT_EQ(place(world), Lines{"w.xml:3: <scatter>: there is room for 1 of 5 only; use a smaller count or gap, or a "
                                  "larger area"});
    world.objects.clear();
  }
  Scatter ring = pillars(5, 2, ScatterPattern::ring);
  ring.ring_radius_m = 1;
  world.scatters = {ring};
  EXPECT_EQ(place(world), Lines{"w.xml:3: <scatter>: there is room for 1 of 5 only; use a smaller count or gap, or a "
                                "larger radius"});
}

TEST(Scatter, ReportsAnUnknownRobotTypeOnce) {
  World world = square();
  Scatter robots;
  robots.count = 100;
  robots.line = {5};
  robots.copied = robotOf("no_such", "R", 6);
  world.scatters = {robots};
  const Lines errors = place(world);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_TRUE(errors[0].starts_with("w.xml:6: robot 'R': there is no robot type 'no_such'; known are:")) << errors[0];
}

/// Random worlds of walls, placed robots and scatters of every pattern: whatever could be placed keeps its gap.
TEST(Scatter, KeepsTheGapInRandomWorlds) {
  std::size_t copies = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    World world = square();
    for (auto i = rng.below(4); i > 0; --i) {
      Body body = pillar(rng.uniform(0.1, 1));
      body.world_from_body = {rng.uniform(-4, 4), rng.uniform(-4, 4), 0};
      world.objects.push_back({.name = "Own" + std::to_string(i), .body = body, .line = {}});
    }
    const std::size_t own = world.objects.size();
    std::vector<double> gaps;
    for (auto i = 1 + rng.below(3); i > 0; --i) {
      Scatter scatter =
          pillars(static_cast<int>(1 + rng.below(8)), rng.uniform(0.05, 0.6), ScatterPattern(rng.below(4)));
      scatter.gap_m = rng.uniform(0, 0.5);
      scatter.ring_radius_m = rng.uniform(1, 4);
      std::get<WorldObject>(scatter.copied).name = "S" + std::to_string(i) + "_";
      world.scatters.push_back(scatter);
      for (int k = 0; k < scatter.count; ++k) gaps.push_back(scatter.gap_m);
    }
    if (!place(world, seed).empty()) continue;
    ASSERT_EQ(world.objects.size(), own + gaps.size());
    for (std::size_t i = own; i < world.objects.size(); ++i) {
      const Body& body = world.objects[i].body;
      const double radius_m = body.coveringRadius();
      EXPECT_LE(std::max(std::abs(body.world_from_body.x), std::abs(body.world_from_body.y)) + radius_m, 5);
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_GE(distance(body.solid().outline, world.objects[k].body.solid().outline), gaps[i - own])
            << world.objects[i].name << " and " << world.objects[k].name << ", seed " << seed;
      }
      ++copies;
    }
  }
  EXPECT_GT(copies, 500u);
}

/// 20 lines of text, 100,000 robots. Their starts pass the check of every loaded world.
TEST(Scatter, LoadsAHundredThousandRobots) {
  const std::string text =
      "<world><surface><size><xmin>-500</xmin><xmax>500</xmax><ymin>-500</ymin><ymax>500</ymax></size>"
      "<scatter count='100000' gap='0.1'><robot model='scout' name='Scout' controller='wander'/></scatter>"
      "</surface></world>";
  WorldSource source{"w.xml", text, robotTypesIn({ROBOSIM_SOURCE_DIR "/worlds/robots"})};
  const LoadedWorld world = loadWorld(source, {});
  EXPECT_EQ(world.fleet.robots.size(), 100'000u);
  EXPECT_EQ(world.fleet.robots.back().info.name, "Scout100000");
}

TEST(Scatter, FollowsTheSeedOfTheSource) {
  const std::string text =
      "<world><surface><size><xmin>-9</xmin><xmax>9</xmax><ymin>-9</ymin><ymax>9</ymax></size>"
      "<scatter count='9'><robot model='scout' name='Scout'/></scatter></surface></world>";
  WorldSource source{"w.xml", text, robotTypesIn({ROBOSIM_SOURCE_DIR "/worlds/robots"})};
  const World of_default = loadWorld(source, {}).world;
  source.seed = kDefaultSeed;
  EXPECT_EQ(loadWorld(source, {}).world, of_default);
  source.seed = 2;
  EXPECT_NE(loadWorld(source, {}).world, of_default);
}

TEST(Scatter, WritesTheCopies) {
  World world = square();
  world.scatters = {pillars(10, 0.3, ScatterPattern::uniform)};
  Scatter robots;
  robots.count = 3;
  robots.copied = robotOf("scout", "Scout", 0);
  world.scatters.push_back(robots);
  world = placed(world);
  world.name = "w";
  ErrorList errors;
  EXPECT_EQ(parseWorld(toXml(world), "w.xml", errors), world);
  EXPECT_TRUE(errors.empty());
}

}  // namespace
}  // namespace robosim
