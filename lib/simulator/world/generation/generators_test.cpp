#include "world/generation/generators.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "world/world_file.h"

namespace robosim {
namespace {

struct Kind {
  std::string name;
  std::function<Scenery(std::uint64_t seed)> make;
  double clearance_m;  ///< of its places
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"maze", [](auto seed) { return generateMaze({.columns = 9, .rows = 7, .braid = 0.5}, seed); }, 0.6},
      {"cave", [](auto seed) { return generateCave({.width_m = 20, .length_m = 16}, seed); }, 0.4},
      {"office", [](auto seed) { return generateOffice({.width_m = 24, .length_m = 22}, seed); }, 0.35},
      {"open", [](auto seed) { return generateOpen({.width_m = 20, .length_m = 14, .clutter = 0.15}, seed); }, 0.4}};
  return all;
}

double distanceToObjects(const mrpt::math::TPoint2D& place, const std::vector<WorldObject>& objects) {
  double nearest = 1e9;
  for (const auto& object : objects) nearest = std::min(nearest, distance(object.body.solid().outline, place));
  return nearest;
}

std::string errorOf(const std::function<void()>& does) {
  try {
    does();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Generators, DependOnlyOnTheSeed) {
  for (const auto& kind : kinds()) {
    const std::string first = toXml(populated(kind.make(5), {}, 5));
    EXPECT_EQ(toXml(populated(kind.make(5), {}, 5)), first) << kind.name;
    EXPECT_NE(toXml(populated(kind.make(6), {}, 6)), first) << kind.name;
  }
}

TEST(Generators, ConnectAllPlacesAndKeepTheirClearance) {
  for (const auto& kind : kinds()) {
    for (std::uint64_t seed = 0; seed < 15; ++seed) {
      SCOPED_TRACE(kind.name + " " + std::to_string(seed));
      const Scenery scenery = kind.make(seed);
      const auto& places = scenery.places.at;
      ASSERT_GE(places.size(), 60u);
      StepsFromSources steps(scenery.places);
      steps.addSource(0);
      for (std::uint32_t i = 0; i < places.size(); ++i) EXPECT_LT(steps.at(i), places.size());
      for (std::size_t i = seed; i < places.size(); i += 7) {
        EXPECT_GE(distanceToObjects(places[i], scenery.objects), kind.clearance_m);
      }
    }
  }
}

TEST(Generators, WriteWorldsThatReadBackEqual) {
  for (const auto& kind : kinds()) {
    const World world = populated(kind.make(3), {.robots = 5}, 3);
    ErrorList errors;
    World read = parseWorld(toXml(world), "w.xml", errors);
    read.name = "";
    EXPECT_EQ(errors.errors(), std::vector<std::string>{}) << kind.name;
    EXPECT_EQ(read, world) << kind.name;
  }
}

TEST(Generators, RejectOptionsOutOfBounds) {
  EXPECT_EQ(errorOf([] { generateMaze({.columns = 1}, 1); }), "columns is 1; it must be 2 to 1000");
  EXPECT_EQ(errorOf([] { generateMaze({.braid = 1.5}, 1); }), "braid is 1.5; it must be 0 to 1");
  EXPECT_EQ(errorOf([] { generateCave({.rock = std::nan("")}, 1); }), "rock is nan; it must be 0 to 0.6");
  EXPECT_EQ(errorOf([] { generateOpen({.width_m = 1e9}, 1); }), "width is 1e+09; it must be 5 to 1000");
  EXPECT_EQ(errorOf([] { generateOffice({.width_m = 30, .length_m = 10, .room_m = 8}, 1); }),
            "rooms of 8 m do not fit beside the corridor; make the office larger");
}

/// Number of passages between cells.
std::size_t passages(const Scenery& maze) {
  std::size_t ends = 0;
  for (const auto& next : maze.places.next) ends += next.size();
  return ends / 2;
}

TEST(Maze, IsATreeWithoutBraids) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scenery maze = generateMaze({.columns = 12, .rows = 8, .braid = 0}, seed);
    EXPECT_EQ(maze.places.at.size(), 96u);
    EXPECT_EQ(passages(maze), 95u);
  }
}

TEST(Maze, HasNoDeadEndsIfAllAreBraided) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scenery maze = generateMaze({.columns = 12, .rows = 8, .braid = 1}, seed);
    for (const auto& next : maze.places.next) EXPECT_GE(next.size(), 2u);
  }
}

TEST(Maze, HasAWallBetweenTwoCellsUnlessThereIsAPassage) {
  const Scenery maze = generateMaze({.columns = 6, .rows = 5, .braid = 0.3, .cell_m = 2}, 9);
  const auto& at = maze.places.at;
  for (std::uint32_t a = 0; a < at.size(); ++a) {
    for (std::uint32_t b = 0; b < at.size(); ++b) {
      if (std::abs(std::hypot(at[a].x - at[b].x, at[a].y - at[b].y) - 2) > 1e-9) continue;
      const auto& next = maze.places.next[a];
      const bool has_passage = std::find(next.begin(), next.end(), b) != next.end();
      EXPECT_EQ(distanceToObjects((at[a] + at[b]) * 0.5, maze.objects) > 0, has_passage) << a << " " << b;
    }
  }
}

/// Whether a place lies within the pitch of an office's places.
bool isNear(const std::vector<mrpt::math::TPoint2D>& places, const mrpt::math::TPoint2D& point) {
  return std::any_of(places.begin(), places.end(), [&](const auto& place) {
    return std::abs(place.x - point.x) < 0.25 && std::abs(place.y - point.y) < 0.25;
  });
}

TEST(Office, HasADoorToEveryRoom) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Scenery office = generateOffice({.width_m = 40, .length_m = 26, .room_m = 3}, seed);
    const auto& b = office.bounds;
    std::size_t free = 0;
    for (double x = b.x_min + 0.5; x < b.x_max; x += 1) {
      for (double y = b.y_min + 0.5; y < b.y_max; y += 1) {
        if (distanceToObjects({x, y}, office.objects) < 0.6) continue;
        ++free;
        EXPECT_TRUE(isNear(office.places.at, {x, y})) << "seed " << seed << ": (" << x << ", " << y << ")";
      }
    }
    EXPECT_GT(free, 300u);
  }
}

TEST(OpenArea, KeepsItsObstaclesApart) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scenery open = generateOpen({.width_m = 25, .length_m = 25, .clutter = 0.3}, seed);
    const auto& objects = open.objects;
    EXPECT_GT(objects.size(), 50u);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      for (std::size_t j = std::max<std::size_t>(4, i + 1); j < objects.size();
           ++j) {  // the first four are outer walls
        EXPECT_GE(distance(objects[i].body.solid().outline, objects[j].body.solid().outline), 0.75) << i << " " << j;
      }
    }
  }
}

TEST(Cave, IsClosedAndMostlyAirWithLittleRock) {
  const Scenery empty = generateCave({.width_m = 20, .length_m = 10, .rock = 0}, 1);
  EXPECT_GE(distanceToObjects({0, 0}, empty.objects), 4) << "rock only at the rim";
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scenery cave = generateCave({.width_m = 30, .length_m = 30, .rock = 0.42}, seed);
    for (const double end : {-14.9, 14.9}) {
      EXPECT_EQ(distanceToObjects({end, 0}, cave.objects), 0);
      EXPECT_EQ(distanceToObjects({0, end}, cave.objects), 0);
    }
  }
}

TEST(PopulatedWorld, SpreadsRobotsAndPutsTheGoldFarFromThem) {
  const Scenery maze = generateMaze({.columns = 10, .rows = 10, .braid = 0}, 4);
  const World world = populated(maze, {.robots = 3, .models = {"scout", "pioneer3dx"}, .controller = "wander"}, 4);
  ASSERT_EQ(world.robots.size(), 3u);
  EXPECT_EQ(world.robots[0].model, "scout");
  EXPECT_EQ(world.robots[1].model, "pioneer3dx");
  EXPECT_EQ(world.robots[2].model, "scout");
  EXPECT_EQ(world.robots[2].neighbour, "Robot1");
  EXPECT_EQ(world.robots[0].controller, "wander");
  const WorldObject& gold = world.objects.back();
  EXPECT_EQ(gold.name, "Gold");
  EXPECT_EQ(gold.body.heat_celsius, 20);
  // By brute force: no place is farther from all robots than the gold.
  const auto place_of = [&](double x, double y) {
    std::uint32_t i = 0;
    while (std::hypot(maze.places.at[i].x - x, maze.places.at[i].y - y) > 1e-9) ++i;
    return i;
  };
  StepsFromSources steps(maze.places);
  for (const auto& robot : world.robots) steps.addSource(place_of(robot.world_from_robot.x, robot.world_from_robot.y));
  const auto of_gold = steps.at(place_of(gold.body.world_from_body.x, gold.body.world_from_body.y));
  for (std::uint32_t i = 0; i < maze.places.at.size(); ++i) EXPECT_LE(steps.at(i), of_gold);
}

TEST(PopulatedWorld, KeepsRobotsApartAndReportsHowManyFit) {
  const Scenery open = generateOpen({.width_m = 6, .length_m = 6, .clutter = 0}, 1);
  const World world = populated(open, {.robots = 10, .has_gold = false}, 1);
  EXPECT_EQ(world.objects.size(), 4u);
  for (const auto& a : world.robots) {
    for (const auto& b : world.robots) {
      if (a.name == b.name) continue;
      EXPECT_GE(std::hypot(a.world_from_robot.x - b.world_from_robot.x, a.world_from_robot.y - b.world_from_robot.y),
                kStartDistance_m);
    }
  }
  const std::string error = errorOf([&] { populated(open, {.robots = 1000}, 1); });
  EXPECT_TRUE(error.starts_with("the generated world has places for ")) << error;
  EXPECT_NE(error.find(" robots, not for 1000; make it larger, or take fewer"), std::string::npos) << error;
}

}  // namespace
}  // namespace robosim
