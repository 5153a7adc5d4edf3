#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "base/random.h"
#include "environment/environment.h"
#include "environment/state_bytes.h"
#include "environment/testing/small_world.h"
#include "geometry/shapes/planar_vector.h"
#include "hardware/gripper_state.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kRadius_m = 0.25;

/// Gives the last robot of a fleet a gripper with paddles of 0.1 m, 0.2 m apart.
void addGripper(Fleet& fleet) {
  FleetRobot& robot = fleet.robots.back();
  auto model = std::make_shared<RobotModel>(*robot.model);
  model->sensors.push_back(sensorFrom("<gripper/>", {1, kRadius_m, 0.3}));
  model->gripper = *gripperOptionsOf(*model->sensors.back());
  auto infos = std::make_shared<std::vector<SensorInfo>>(*model->sensor_infos);
  infos->push_back(model->sensors.back()->info());
  model->sensor_infos = robot.info.sensors = infos;
  robot.model = model;
}

void addCan(World& world, const TPose2D& at, double radius_m = 0.05, const Movable& movable = {}) {
  addBox(world, at, 1, 1, movable);
  Body& body = world.objects.back().body;
  world.objects.back().name = "can" + std::to_string(world.objects.size() - 1);
  body.shape = Cylinder{radius_m};
  body.height_m = 0.12;
  body.center_z_m = 0.06;
}

struct Cans {
  World world = emptyWorld(4);
  Fleet fleet;

  /// A robot at the origin with a can of 5 cm radius 1 cm ahead of it.
  Cans() {
    addCan(world, {kRadius_m + 0.06, 0, 0});
    addDisc(world, fleet, "robot", {0, 0, 0});
    addGripper(fleet);
  }
  std::unique_ptr<Environment> environment() const {
    return std::make_unique<Environment>(World(world), Fleet(fleet), EnvironmentOptions{});
  }
};

void stepWith(Environment& environment, const Command& command, int steps = 1, std::size_t robot = 0) {
  for (int i = 0; i < steps; ++i) {
    environment.setCommand(robot, command);
    environment.step();
  }
}

const TPose2D& objectPose(const Environment& environment, std::size_t object) {
  return environment.objects()[object].body.world_from_body;
}

GripperState gripperOf(const Environment& environment, std::size_t robot = 0) {
  return GripperState::from(std::get<Values>(environment.state().readings[robot].measurements[1]));
}

/// Where an object is in the frame of the robot.
TPoint2D inRobot(const Environment& environment, std::size_t object) {
  const TPose2D& robot = environment.state().world_from_robot[0];
  const TPose2D& at = objectPose(environment, object);
  const double x_m = at.x - robot.x, y_m = at.y - robot.y;
  return {std::cos(robot.phi) * x_m + std::sin(robot.phi) * y_m, std::cos(robot.phi) * y_m - std::sin(robot.phi) * x_m};
}

TEST(Gripper, CarriesWhatIsBetweenItsPaddlesUntilItOpens) {
  const auto environment = Cans().environment();
  stepWith(*environment, {});
  EXPECT_EQ(gripperOf(*environment), (GripperState{.inner_beam = true, .outer_beam = true}));
  stepWith(*environment, {.grip = true});
  EXPECT_TRUE(gripperOf(*environment).holds);
  stepWith(*environment, {.speed_mps = -0.5, .turn_radps = 1, .grip = true}, 20);
  const auto& robot = environment->state().world_from_robot[0];
  EXPECT_NEAR(robot.phi, 2, 1e-12);
  EXPECT_NEAR(inRobot(*environment, 0).x, kRadius_m + 0.06, 1e-12);
  EXPECT_NEAR(inRobot(*environment, 0).y, 0, 1e-12);
  EXPECT_NEAR(objectPose(*environment, 0).phi, 2, 1e-12) << "it turns with the robot";

  const TPose2D dropped = objectPose(*environment, 0);
  stepWith(*environment, {.speed_mps = -0.5}, 5);
  EXPECT_EQ(objectPose(*environment, 0), dropped);
  EXPECT_EQ(gripperOf(*environment), GripperState{});
}

TEST(Gripper, ClosesOnNothingElse) {
  const auto holds = [](const std::function<void(Cans&)>& change) {
    Cans cans;
    change(cans);
    const auto environment = cans.environment();
    stepWith(*environment, {.grip = true});
    EXPECT_TRUE(gripperOf(*environment).is_closed);
    return gripperOf(*environment).holds;
  };
  const auto with_body = [&](double x_m, double y_m, double radius_m) {
    return holds([&](Cans& cans) {
      cans.world.objects[0].body.world_from_body = {x_m, y_m, 0};
      cans.world.objects[0].body.shape = Cylinder{radius_m};
    });
  };
  EXPECT_TRUE(with_body(0.349, 0.049, 0.05));
  EXPECT_FALSE(with_body(0.351, 0, 0.05)) << "beyond the tips";
  EXPECT_FALSE(with_body(0.34, 0.051, 0.05)) << "a paddle is in the way";
  EXPECT_FALSE(with_body(0.352, 0, 0.101)) << "too wide";
  EXPECT_FALSE(with_body(-0.31, 0, 0.05)) << "behind";
  EXPECT_FALSE(holds([](Cans& cans) { cans.world.objects[0].movable.reset(); })) << "stationary";
  // The friction of 7 kg is 0.5 · 7 kg · 9.81 m/s² = 34 N, that of 6 kg is 29 N.
  EXPECT_TRUE(holds([](Cans& cans) { cans.world.objects[0].movable->mass_kg = 6; }));
  EXPECT_FALSE(holds([](Cans& cans) { cans.world.objects[0].movable->mass_kg = 7; })) << "heavier than it can push";
  EXPECT_FALSE(holds([](Cans& cans) { cans.world.objects[0].body.center_z_m += 0.05; })) << "above the paddles";
}

TEST(Gripper, ThatIsClosedAlreadyHoldsNothingThatComes) {
  Cans cans;
  cans.world.objects[0].body.world_from_body.x = 1;
  const auto environment = cans.environment();
  stepWith(*environment, {.speed_mps = 0.5, .grip = true}, 20);
  EXPECT_GT(objectPose(*environment, 0).x, 1.2) << "it pushes the can";
  EXPECT_FALSE(gripperOf(*environment).holds);
  stepWith(*environment, {});
  stepWith(*environment, {.grip = true});
  EXPECT_TRUE(gripperOf(*environment).holds);
}

TEST(Gripper, HoldsAnObjectThatStopsTurnsAndDrivesAtWalls) {
  Cans cans;
  // Its near side at y = 0.2, where the can, 0.31 m from the centre, is after a turn of asin(0.15 / 0.31).
  addWall(cans.world, 0, 0.75, 8, 1.1);
  const auto environment = cans.environment();
  stepWith(*environment, {.grip = true});
  stepWith(*environment, {.turn_radps = 1, .grip = true}, 20);
  const auto& robot = environment->state().world_from_robot[0];
  EXPECT_NEAR(robot.phi, std::asin(0.15 / 0.31), 1e-5);
  EXPECT_TRUE(environment->state().stalled[0]);
  EXPECT_EQ(environment->state().turn_radps[0], 0);
  EXPECT_LT(objectPose(*environment, 0).y + 0.05, 0.2);

  stepWith(*environment, {.turn_radps = -2, .grip = true}, 8);
  EXPECT_FALSE(environment->state().stalled[0]) << "it turns away";
  stepWith(*environment, {.speed_mps = 1, .grip = true}, 100);
  EXPECT_TRUE(environment->state().stalled[0]) << "at the edge of the surface, which the can reaches before it";
  const auto& can = objectPose(*environment, 0);
  EXPECT_NEAR(std::max(std::abs(can.x), std::abs(can.y)), 4 - 0.05, 2e-5);
}

TEST(Gripper, HoldsAnObjectThatPushesOthers) {
  Cans cans;
  addBox(cans.world, {1, 0, 0}, 0.4, 0.4, {.mass_kg = 2});
  const auto environment = cans.environment();
  stepWith(*environment, {.grip = true});
  stepWith(*environment, {.speed_mps = 0.5, .grip = true}, 40);
  const double front_m = environment->state().world_from_robot[0].x + kRadius_m + 0.06 + 0.05;
  EXPECT_NEAR(environment->state().world_from_robot[0].x, 2, 1e-12);
  EXPECT_NEAR(objectPose(*environment, 1).x, front_m + 0.2, 1e-5);
  stepWith(*environment, {.speed_mps = 0.5, .grip = true}, 40);
  EXPECT_TRUE(environment->state().stalled[0]) << "the box is at the edge of the surface";
  EXPECT_NEAR(objectPose(*environment, 0).x, 4 - 0.4 - 0.05, 1e-4);
}

TEST(Gripper, HoldsAnObjectThatStopsOtherRobotsAndIsSensed) {
  Cans cans;
  addDisc(cans.world, cans.fleet, "other", {2, 0, M_PI});
  const auto environment = cans.environment();
  stepWith(*environment, {.grip = true});
  for (int i = 0; i < 40; ++i) {
    environment->setCommand(0, {.grip = true});
    environment->setCommand(1, {.speed_mps = 0.5});
    environment->step();
  }
  EXPECT_NEAR(environment->state().world_from_robot[1].x, kRadius_m + 0.11 + kRadius_m, 1e-5);
  EXPECT_NEAR(objectPose(*environment, 0).x, kRadius_m + 0.06, 1e-12) << "it is not pushed out of the gripper";
}

TEST(Gripper, DropsWhatAnInterventionTakes) {
  const auto environment = Cans().environment();
  stepWith(*environment, {.grip = true});
  EXPECT_EQ(environment->apply({"test", PlaceBody{"can0", -2, 0}}), "");
  stepWith(*environment, {.speed_mps = 0.5, .grip = true}, 5);
  EXPECT_FALSE(gripperOf(*environment).holds);
  EXPECT_EQ(objectPose(*environment, 0), TPose2D(-2, 0, 0));

  const auto moved = Cans().environment();
  stepWith(*moved, {.grip = true});
  EXPECT_EQ(moved->apply({"test", PlaceBody{"robot", -2, 0}}), "");
  stepWith(*moved, {.speed_mps = 0.5, .grip = true}, 5);
  EXPECT_EQ(objectPose(*moved, 0), TPose2D(kRadius_m + 0.06, 0, 0));

  const auto removed = Cans().environment();
  stepWith(*removed, {.grip = true});
  EXPECT_EQ(removed->apply({"test", RemoveBody{"can0"}}), "");
  stepWith(*removed, {.grip = true});
  EXPECT_FALSE(gripperOf(*removed).holds);
}

TEST(Gripper, ContinuesFromASavedState) {
  const Cans cans;
  const auto first = cans.environment();
  stepWith(*first, {.grip = true});
  stepWith(*first, {.speed_mps = 0.3, .turn_radps = 0.5, .grip = true}, 5);
  const std::string saved = toBytes(*first->model(), first->state());
  stepWith(*first, {.speed_mps = 0.3, .turn_radps = 0.5, .grip = true}, 5);
  const auto second = cans.environment();
  second->restore(stateFromBytes(*second->model(), saved));
  stepWith(*second, {.speed_mps = 0.3, .turn_radps = 0.5, .grip = true}, 5);
  EXPECT_EQ(second->state(), first->state());
}

/// Robots with grippers among cans and boxes in a small room, which drive and grip at random.
struct Crowd {
  World world = emptyWorld(2);
  Fleet fleet;
  Rng rng;

  explicit Crowd(std::uint64_t seed) : rng(seed) {
    addWall(world, rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5), 0.6, 0.1, rng.uniform(-3, 3));
    for (int i = 0; i < 4; ++i) place(0.3, [&](const TPose2D& at) { addGripping(at); });
    for (int i = 0; i < 12; ++i) place(0.07, [&](const TPose2D& at) { addCan(world, at, rng.uniform(0.03, 0.07)); });
    for (int i = 0; i < 3; ++i) place(0.15, [&](const TPose2D& at) { addBox(world, at, 0.2, 0.12); });
    for (auto& object : world.objects) {
      if (object.movable) object.movable->mass_kg = rng.uniform(0.2, 3);
    }
  }
  void addGripping(const TPose2D& at) {
    addDisc(world, fleet, "robot" + std::to_string(fleet.robots.size()), at);
    addGripper(fleet);
  }
  template <typename Add>
  void place(double radius_m, const Add& add) {
    for (;;) {
      const TPose2D at(rng.uniform(-1.7, 1.7), rng.uniform(-1.7, 1.7), rng.uniform(-3, 3));
      const Outline disc = Circle{{at.x, at.y}, radius_m + 0.01};
      bool is_free = true;
      for (const auto& object : world.objects) is_free = is_free && !overlap(disc, object.body.solid().outline);
      for (const auto& robot : fleet.robots) {
        is_free = is_free &&
                  !overlap(disc, Circle{{robot.world_from_start.x, robot.world_from_start.y}, robot.info.radius_m});
      }
      if (!is_free) continue;
      return add(at);
    }
  }
  static bool overlap(const Outline& a, const Outline& b) {
    return robosim::overlap(Solid{a, {0, 1}}, Solid{b, {0, 1}});
  }
  void driveAtRandom(Environment& environment) {
    for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
      Command command = environment.state().commands[i];
      if (rng.below(6) == 0) {
        command.speed_mps = rng.uniform(-0.6, 1);
        command.turn_radps = rng.below(2) ? rng.uniform(-2, 2) : 0;
      }
      const auto gripper = gripperOf(environment, i);
      if (gripper.inner_beam || gripper.outer_beam) command.grip = true;
      if (rng.below(100) == 0) command.grip = false;
      environment.setCommand(i, command);
    }
    environment.step();
  }
};

TEST(Gripper, LetsNothingOverlap) {
  const int worlds = std::getenv("ROBOSIM_VERIFY") ? 10000 : 60;
  std::size_t held_steps = 0;
  for (int seed = 0; seed < worlds; ++seed) {
    Crowd crowd(static_cast<std::uint64_t>(seed));
    Environment environment(World(crowd.world), Fleet(crowd.fleet), EnvironmentOptions{});
    for (int i = 0; i < 150; ++i) {
      crowd.driveAtRandom(environment);
      const State& state = environment.state();
      for (const auto& gripper : state.closed_grippers) held_steps += gripper.object.empty() ? 0 : 1;
      // By brute force: discs of robots, and the cans' and boxes' true outlines.
      std::vector<Outline> solids;
      std::vector<std::string> names;
      for (std::size_t r = 0; r < crowd.fleet.robots.size(); ++r) {
        solids.push_back(Circle{{state.world_from_robot[r].x, state.world_from_robot[r].y}, kRadius_m - 1e-9});
        names.push_back(crowd.fleet.robots[r].info.name);
      }
      for (const auto& object : environment.objects()) {
        solids.push_back(object.body.solid().outline);
        if (auto* circle = std::get_if<Circle>(&solids.back())) circle->radius_m -= 1e-9;
        if (auto* box = std::get_if<OrientedBox>(&solids.back())) {
          box->half_length_m -= 1e-9;
          box->half_width_m -= 1e-9;
        }
        names.push_back(object.name);
      }
      for (std::size_t a = 0; a < solids.size(); ++a) {
        ASSERT_TRUE(crowd.world.bounds.covers(boundsOf(solids[a]))) << seed << ", " << i << ": " << names[a];
        for (std::size_t b = 0; b < a; ++b) {
          ASSERT_FALSE(Crowd::overlap(solids[a], solids[b]))
              << seed << ", " << i << ": " << names[a] << " " << names[b];
        }
      }
    }
  }
  EXPECT_GT(held_steps, worlds * 20u);
}

TEST(Gripper, ActsAlikeWithAnyNumberOfThreads) {
  std::string of_one;
  for (const int threads : {1, 2, 3, 8}) {
    Crowd crowd(7);
    Environment environment(World(crowd.world), Fleet(crowd.fleet), EnvironmentOptions{.threads = threads});
    for (int i = 0; i < 100; ++i) crowd.driveAtRandom(environment);
    EXPECT_FALSE(environment.state().closed_grippers.empty());
    if (threads == 1) of_one = environment.digest();
    EXPECT_EQ(environment.digest(), of_one) << threads;
  }
}

}  // namespace
}  // namespace robosim
