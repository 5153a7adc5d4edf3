// Every controller in random worlds: no robot may stay in one place for ten minutes. With ROBOSIM_VERIFY=1 the test
// runs a day of simulated time in 20 worlds.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"
#include "environment/start_poses.h"
#include "environment/testing/small_world.h"
#include "maze/controllers.h"
#include "run/local_run.h"
#include "tests/scenarios/verifying.h"

namespace robosim {
namespace {

constexpr double kPlace_m = 0.5;  ///< a robot within this distance has not moved
constexpr double kLongest_s = 600;

void addRobot(World& world, const std::string& model, const mrpt::math::TPose2D& start) {
  RobotPlacement robot;
  robot.name = "r" + std::to_string(world.robots.size());
  robot.model = model;
  robot.world_from_robot = start;
  world.robots.push_back(robot);
}

LoadedWorld withFleet(World world) {
  ErrorList errors;
  LoadedWorld loaded{std::move(world), {}};
  loaded.fleet = buildFleet(loaded.world, "made", robotTypesIn(robotTypeFolders("")), {}, errors);
  errors.throwIfAny();
  return loaded;
}

/// A square of 12 m to 24 m with 4 robots in the middle and, around them, walls in any direction, pillars, and objects
/// too low for a sonar. Two of three worlds have walls along the edge, half of these with a gap.
LoadedWorld madeWorld(std::uint64_t seed) {
  Rng rng(seed, RandomPurpose::scenery);
  const double half_m = rng.uniform(6, 12);
  World world = emptyWorld(half_m);
  world.name = "made " + std::to_string(seed);
  if (seed % 3 != 0) {
    addWall(world, -half_m, 0, 0.1, 2 * half_m);
    addWall(world, half_m, 0, 0.1, 2 * half_m);
    addWall(world, 0, -half_m, 2 * half_m, 0.1);
    if (seed % 3 == 1) addWall(world, 0, half_m, 2 * half_m, 0.1);
  }
  const int count = 10 + static_cast<int>(rng.below(20));
  for (int i = 0; i < count;) {
    const double x = rng.uniform(-half_m, half_m), y = rng.uniform(-half_m, half_m);
    const double length_m = rng.uniform(0.05, 4);
    if (std::hypot(x, y) < 2 + length_m / 2) continue;  // keeps the middle free
    addWall(world, x, y, length_m, rng.uniform(0.05, 0.5), rng.uniform(-std::numbers::pi, std::numbers::pi));
    if (rng.below(4) == 0) {
      Body& low = world.objects.back().body;
      low.height_m = 0.1;
      low.center_z_m = 0.05;
    }
    ++i;
  }
  for (int i = 0; i < 4; ++i) {
    const double x = i < 2 ? -1 : 1, y = i % 2 ? -1 : 1;
    addRobot(world, i % 2 ? "scout" : "pioneer3dx", {x, y, rng.uniform(-3, 3)});
  }
  return withFleet(std::move(world));
}

struct Stay {
  std::string robot;
  double from_s = 0;
  mrpt::math::TPose2D at;
};

std::ostream& operator<<(std::ostream& out, const Stay& stay) {
  return out << stay.robot << " stays at " << stay.at << " from " << stay.from_s << " s on";
}

/// The first robot that stays in one place for kLongest_s without having finished its task.
std::optional<Stay> firstStay(LocalRun& run, double time_s) {
  const Environment& environment = run.environment();
  std::vector<Stay> stays(environment.robotCount());
  for (std::size_t i = 0; i < stays.size(); ++i) {
    stays[i] = {environment.fleet().robots[i].info.name, 0, environment.state().world_from_robot[i]};
  }
  while (environment.time().seconds() < time_s && !run.gold().all_halted_s) {
    run.step();
    const State& state = environment.state();
    for (std::size_t i = 0; i < stays.size(); ++i) {
      const auto& pose = state.world_from_robot[i];
      const double now_s = state.time.seconds();
      if (std::hypot(pose.x - stays[i].at.x, pose.y - stays[i].at.y) > kPlace_m) {
        stays[i].from_s = now_s;
        stays[i].at = pose;
      }
      if (state.activity[i] == Activity::active && now_s - stays[i].from_s >= kLongest_s) return stays[i];
    }
  }
  return std::nullopt;
}

class Standstill : public testing::TestWithParam<std::string> {};

TEST_P(Standstill, NeverLasts) {
  const std::uint64_t worlds = isVerifying() ? 20 : 1;
  const double time_s = isVerifying() ? 86400 : 900;
  for (std::uint64_t seed = 1; seed <= worlds; ++seed) {
    LoadedWorld world = madeWorld(seed);
    RunOptions options;
    options.environment.seed = seed;
    options.controller = GetParam();
    LocalRun run(std::move(world), options);
    const auto stay = firstStay(run, time_s);
    EXPECT_FALSE(stay) << "world " << seed << ": " << *stay;
  }
}

/// All controllers except the idle one, and those of demonstrations that stand where a world lacks what they wait for:
/// beacons, a partner at a crate, a doorway (demonstrations_test.cpp runs them in worlds that have it).
std::vector<std::string> driving() {
  std::vector<std::string> names = controllers().names();
  for (const char* const waiting : {"still", "soccer", "push_together", "hold_door", "pass_door"}) {
    std::erase(names, waiting);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(OfEveryController, Standstill, testing::ValuesIn(driving()),
                         [](const auto& test) { return test.param; });

/// Distance driven by a robot, and number of its steps that end in a stall.
struct Driven {
  double m = 0;
  std::uint64_t stalls = 0;
};

Driven drivenOnOpenGround(const std::string& controller, double time_s) {
  World world = emptyWorld(4);
  addRobot(world, "pioneer3dx", {0, 0, 0.3});
  RunOptions options;
  options.controller = controller;
  LocalRun run(withFleet(std::move(world)), options);
  while (run.environment().time().seconds() < time_s) run.step();
  return {run.environment().state().driven_m[0], run.environment().state().stalls};
}

TEST(Edge, DoesNotTrapTheWanderController) {
  // Its speed is up to 1 m/s; half of the steps would stall if it kept driving against the edge.
  const Driven driven = drivenOnOpenGround("wander", 600);
  EXPECT_GT(driven.m, 100);
  EXPECT_LT(driven.stalls, 600u);
}

TEST(Edge, DoesNotTrapTheWallFollower) {
  const Driven driven = drivenOnOpenGround("wall_follower", 600);
  EXPECT_GT(driven.m, 60);
  EXPECT_LT(driven.stalls, 600u);
}

}  // namespace
}  // namespace robosim
