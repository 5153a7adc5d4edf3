// Motion of robots whose drive is not differential.
#include <cmath>
#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/random.h"
#include "environment/state_bytes.h"
#include "environment/testing/small_world.h"
#include "sensors/odometry.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

constexpr double kDrivenRadius_m = 0.25;
constexpr Drive kOmniDrive{.kind = DriveKind::omni};
constexpr Drive kCarDrive{.kind = DriveKind::car, .wheelbase_m = 0.5, .steering_max_rad = 45 * kRadPerDeg};
constexpr Drive kTrackedDrive{.kind = DriveKind::tracked, .track_factor = 2, .icr_x_m = -0.1};

/// Gives the last robot a drive, with speeds of up to 1 m/s that are reached immediately.
void giveDrive(Fleet& fleet, const Drive& drive) {
  FleetRobot& robot = fleet.robots.back();
  auto model = std::make_shared<RobotModel>(*robot.model);
  RobotTypeInfo& type = model->type.edit();
  type.drive = drive;
  if (drive.kind == DriveKind::omni) type.limits.lateral_max_mps = 1;
  robot.info.type = model->type;
  robot.model = model;
}

/// One robot in an empty square of 10 m, with steps of 0.1 s.
struct DrivenRobot {
  explicit DrivenRobot(const Drive& drive, const TPose2D& start = {}, World world_with = emptyWorld(5)) {
    Fleet fleet;
    addDisc(world_with, fleet, "robot", start, kDrivenRadius_m);
    giveDrive(fleet, drive);
    environment = std::make_unique<Environment>(std::move(world_with), std::move(fleet),
                                                EnvironmentOptions{.seed = 1, .period_s = 0.1});
  }
  void drive(const Command& command, int steps = 1) {
    for (int i = 0; i < steps; ++i) {
      environment->setCommand(0, command);
      environment->step();
    }
  }
  const TPose2D& pose() const { return environment->state().world_from_robot[0]; }
  Odometry odometry() const { return std::get<Odometry>(environment->state().readings[0].measurements[0]); }

  std::unique_ptr<Environment> environment;
};

void expectDrivenTo(const TPose2D& pose, const TPose2D& expected) {
  EXPECT_NEAR(pose.x, expected.x, 1e-9);
  EXPECT_NEAR(pose.y, expected.y, 1e-9);
  EXPECT_NEAR(std::remainder(pose.phi - expected.phi, 2 * M_PI), 0, 1e-9);
}

TEST(Drives, AnOmnidirectionalRobotDrivesSideways) {
  DrivenRobot robot(kOmniDrive, {1, 0, M_PI_2});
  robot.drive({.speed_mps = 0.3, .lateral_mps = 0.4}, 10);
  expectDrivenTo(robot.pose(), {0.6, 0.3, M_PI_2});
  expectDrivenTo(robot.odometry().odom_from_robot, {0.3, 0.4, 0});
  EXPECT_NEAR(robot.odometry().speed_mps, 0.3, 1e-12);
  EXPECT_NEAR(robot.odometry().lateral_mps, 0.4, 1e-12);
  EXPECT_NEAR(robot.environment->state().driven_m[0], 0.5, 1e-12) << "the hypotenuse";
}

TEST(Drives, AnOmnidirectionalRobotThatTurnsDrivesAnArc) {
  // Sideways at v while it turns at ω: about a point v / ω behind it. After a quarter: (-v/ω, v/ω).
  DrivenRobot robot(kOmniDrive);
  robot.drive({.turn_radps = M_PI_2, .lateral_mps = M_PI_4}, 10);
  expectDrivenTo(robot.pose(), {-0.5, 0.5, M_PI_2});
  expectDrivenTo(robot.odometry().odom_from_robot, {-0.5, 0.5, M_PI_2});
}

TEST(Drives, AnOmnidirectionalRobotStopsAtAContactAtItsSide) {
  World world = emptyWorld(5);
  addWall(world, 0, 1, 4, 0.2);
  DrivenRobot robot(kOmniDrive, {}, std::move(world));
  robot.drive({.speed_mps = 0.5, .lateral_mps = 1}, 10);
  // 0.65 m to the wall, in 0.65 s; it then starts from rest at a wall that is in its way.
  EXPECT_NEAR(robot.pose().y, 0.9 - kDrivenRadius_m - kContactGap_m, 1e-9);
  EXPECT_NEAR(robot.pose().x, 0.325, 1e-5);
  EXPECT_TRUE(robot.environment->state().stalled[0]);
  EXPECT_EQ(robot.odometry().lateral_mps, 0);
  robot.drive({.speed_mps = 0.5}, 2);
  EXPECT_NEAR(robot.pose().x, 0.425, 1e-5) << "along the wall";
}

TEST(Drives, OtherRobotsIgnoreALateralSpeed) {
  for (const Drive& drive : {Drive(), kCarDrive, kTrackedDrive}) {
    DrivenRobot robot(drive);
    robot.drive({.speed_mps = 0.5, .lateral_mps = 1}, 10);
    expectDrivenTo(robot.pose(), {0.5, 0, 0});
  }
}

TEST(Drives, ACarDrivesCirclesOfItsSteeringAngle) {
  // 1 m/s and 1 rad/s: a circle of 1 m about the point 1 m to the left.
  DrivenRobot robot(kCarDrive);
  robot.drive({.speed_mps = 1, .turn_radps = 1}, 10);
  expectDrivenTo(robot.pose(), {std::sin(1), 1 - std::cos(1), 1});
  EXPECT_NEAR(std::tan(robot.environment->state().drives[0].steering_rad), 0.5, 1e-12) << "wheelbase by radius";
  // Backwards on the same circle.
  robot.drive({.speed_mps = -1, .turn_radps = -1}, 11);  // the first step brakes to rest
  expectDrivenTo(robot.pose(), {0, 0, 0});
}

TEST(Drives, TheOriginOfACarNeedNotBeOnItsRearAxle) {
  // The axle drives a quarter of the circle about (-0.2, 1): from (-0.2, 0) to (0.8, 1). The origin is 0.2 m ahead.
  Drive drive = kCarDrive;
  drive.icr_x_m = -0.2;
  DrivenRobot robot(drive);
  robot.drive({.speed_mps = M_PI_4, .turn_radps = M_PI_4}, 20);
  expectDrivenTo(robot.pose(), {0.8, 1.2, M_PI_2});
  expectDrivenTo(robot.odometry().odom_from_robot, {0.8, 1.2, M_PI_2});
}

TEST(Drives, TheSteeringAngleOfACarIsLimited) {
  // 45°: no circle is smaller than its wheelbase of 0.5 m. After half of it, at 2 rad/s:
  DrivenRobot robot(kCarDrive);
  robot.drive({.speed_mps = M_PI_4, .turn_radps = 2}, 20);
  expectDrivenTo(robot.pose(), {0, 1, M_PI});
}

TEST(Drives, ACarDoesNotTurnOnTheSpot) {
  DrivenRobot robot(kCarDrive);
  robot.drive({.turn_radps = 2}, 10);
  expectDrivenTo(robot.pose(), {0, 0, 0});
  EXPECT_EQ(robot.odometry().turn_radps, 0);
}

TEST(Drives, ACarIsSteeredAtTheRateOfItsWheels) {
  Drive drive = kCarDrive;
  drive.steering_rate_radps = 0.5;
  DrivenRobot robot(drive);
  for (const double steering_rad : {0.05, 0.1, 0.15}) {
    robot.drive({.speed_mps = 1, .turn_radps = 1});
    EXPECT_NEAR(robot.environment->state().turn_radps[0], std::tan(steering_rad) / 0.5, 1e-12);
  }
}

TEST(Drives, ACarIsNotSteeredBeyondItsLockByRounding) {
  Drive drive = kCarDrive;
  drive.steering_max_rad = 10 * kRadPerDeg;
  drive.steering_rate_radps = M_PI;
  DrivenRobot robot(drive);
  robot.drive({.speed_mps = 1, .turn_radps = -0.2}, 10);
  for (int step = 0; step < 5; ++step) {
    robot.drive({.speed_mps = 1, .turn_radps = 5});
    EXPECT_LE(robot.environment->state().drives[0].steering_rad, drive.steering_max_rad);
  }
}

TEST(Drives, ACarThatIsBlockedDoesNotTurn) {
  World world = emptyWorld(5);
  addWall(world, 1, 0, 0.2, 4);
  DrivenRobot robot(kCarDrive, {}, std::move(world));
  robot.drive({.speed_mps = 1, .turn_radps = 0.2}, 20);
  // On a circle of 5 m the disc meets the wall at x = 0.65 m.
  const double turned_rad = std::asin((0.65 - kContactGap_m) / 5);
  EXPECT_NEAR(robot.pose().x, 0.65 - kContactGap_m, 1e-7);
  EXPECT_NEAR(robot.pose().phi, turned_rad, 1e-6);
  EXPECT_EQ(robot.environment->state().turn_radps[0], 0);
}

TEST(Drives, TracksTurnLessThanTheyAreCommanded) {
  Drive drive = kTrackedDrive;
  drive.icr_x_m = 0;
  DrivenRobot robot(drive);
  robot.drive({.turn_radps = 1}, 10);
  expectDrivenTo(robot.pose(), {0, 0, 0.5});
  EXPECT_NEAR(robot.odometry().turn_radps, 0.5, 1e-12) << "exact odometry";
}

TEST(Drives, TracksTurnAboutTheirCentreOfRotation) {
  // About the point 0.1 m behind the origin: after half a turn the origin is behind that.
  DrivenRobot robot(kTrackedDrive);
  robot.drive({.turn_radps = M_PI_2 * 4 / 5}, 50);
  expectDrivenTo(robot.pose(), {-0.2, 0, M_PI});
  expectDrivenTo(robot.odometry().odom_from_robot, {-0.2, 0, M_PI});
}

/// Robots of all drives among walls in a small room.
struct DriveCrowd {
  World world = emptyWorld(2.5);
  Fleet fleet;
  Rng rng;

  explicit DriveCrowd(std::uint64_t seed) : rng(seed) {
    for (int i = 0; i < 3; ++i) {
      addWall(world, rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(0.2, 1.5), 0.1, rng.uniform(-3, 3));
    }
    const Drive drives[] = {Drive(), kOmniDrive, kCarDrive, kTrackedDrive};
    for (int i = 0; i < 10; ++i) add(drives[rng.below(4)], rng.uniform(0.1, 0.3));
  }
  void add(Drive drive, double radius_m) {
    for (;;) {
      const TPose2D at(rng.uniform(-2.1, 2.1), rng.uniform(-2.1, 2.1), rng.uniform(-3, 3));
      const Circle disc{{at.x, at.y}, radius_m + 0.01};
      bool is_free = true;
      for (const auto& object : world.objects) is_free = is_free && !overlaps(disc, object.body.solid().outline);
      for (const auto& robot : fleet.robots) {
        is_free = is_free &&
                  !overlaps(disc, Circle{{robot.world_from_start.x, robot.world_from_start.y}, robot.info.radius_m});
      }
      if (!is_free) continue;
      addDisc(world, fleet, "robot" + std::to_string(fleet.robots.size()), at, radius_m, {1, 2, 3, 3, 8});
      if (drive.kind == DriveKind::car) drive.steering_rate_radps = rng.below(2) * 1.0;
      return giveDrive(fleet, drive);
    }
  }
  static bool overlaps(const Outline& a, const Outline& b) { return overlap(Solid{a, {0, 1}}, Solid{b, {0, 1}}); }
  void driveAtRandom(Environment& environment) {
    for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
      if (rng.below(6) != 0) continue;
      environment.setCommand(i, {.speed_mps = rng.uniform(-0.6, 1),
                                 .turn_radps = rng.below(2) ? rng.uniform(-2, 2) : 0,
                                 .lateral_mps = rng.below(2) ? rng.uniform(-1, 1) : 0});
    }
    environment.step();
  }
};

TEST(Drives, LetNothingOverlap) {
  const int worlds = std::getenv("ROBOSIM_VERIFY") ? 10000 : 60;
  std::size_t stalls = 0;
  for (int seed = 0; seed < worlds; ++seed) {
    DriveCrowd crowd(static_cast<std::uint64_t>(seed));
    Environment environment(World(crowd.world), Fleet(crowd.fleet), EnvironmentOptions{});
    for (int i = 0; i < 150; ++i) {
      crowd.driveAtRandom(environment);
      const State& state = environment.state();
      for (const auto stalled : state.stalled) stalls += stalled;
      std::vector<Outline> solids;
      for (const auto& object : crowd.world.objects) solids.push_back(object.body.solid().outline);
      const std::size_t walls = solids.size();
      for (std::size_t r = 0; r < crowd.fleet.robots.size(); ++r) {
        const auto& pose = state.world_from_robot[r];
        solids.push_back(Circle{{pose.x, pose.y}, crowd.fleet.robots[r].info.radius_m - 1e-9});
        ASSERT_TRUE(crowd.world.bounds.covers(boundsOf(solids.back()))) << seed << ", " << i << ": " << r;
      }
      for (std::size_t a = walls; a < solids.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          ASSERT_FALSE(DriveCrowd::overlaps(solids[a], solids[b])) << seed << ", " << i << ": " << a << " " << b;
        }
      }
    }
  }
  EXPECT_GT(stalls, worlds * 20u);
}

TEST(Drives, MoveAlikeWithAnyNumberOfThreads) {
  std::string of_one;
  for (const int threads : {1, 2, 3, 8}) {
    DriveCrowd crowd(7);
    Environment environment(World(crowd.world), Fleet(crowd.fleet), EnvironmentOptions{.threads = threads});
    for (int i = 0; i < 100; ++i) crowd.driveAtRandom(environment);
    if (threads == 1) of_one = environment.digest();
    EXPECT_EQ(environment.digest(), of_one) << threads;
  }
}

TEST(Drives, AreContinuedFromASavedState) {
  DriveCrowd crowd(3);
  Environment first{World(crowd.world), Fleet(crowd.fleet), EnvironmentOptions{}};
  for (int i = 0; i < 30; ++i) crowd.driveAtRandom(first);
  Environment second{World(crowd.world), Fleet(crowd.fleet), EnvironmentOptions{}};
  second.restore(stateFromBytes(*second.model(), toBytes(*first.model(), first.state())));
  for (int i = 0; i < 30; ++i) {
    first.step();
    second.step();
  }
  EXPECT_EQ(second.state(), first.state());
}

}  // namespace
}  // namespace robosim
