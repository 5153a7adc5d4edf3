// Tests of odometry as UMBmark is one for differential drives: for each drive, paths whose ends show its errors.
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "environment/testing/small_world.h"
#include "sensors/odometry.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

/// A robot in an empty square of 20 m, with systematic errors of its odometry only, and steps of 0.1 s.
struct MeasuredRobot {
  MeasuredRobot(const Drive& drive, WheelErrors wheels) {
    wheels.drive = drive;
    World world = emptyWorld(10);
    Fleet fleet;
    addDisc(world, fleet, "robot", {}, 0.25, {1, 2, 1e6, 1e6, 1e6, 0, 1});
    FleetRobot& robot = fleet.robots.back();
    auto model = std::make_shared<RobotModel>(*robot.model);
    model->type.edit().drive = drive;
    robot.info.type = model->type;
    model->sensors = {makeOdometry({.noise = {true, 0, 0, 0}, .wheels = wheels})};
    robot.model = model;
    environment = std::make_unique<Environment>(std::move(world), std::move(fleet),
                                                EnvironmentOptions{.seed = 1, .period_s = 0.1});
  }
  void drive(const Command& command, int steps) {
    for (int i = 0; i < steps; ++i) {
      environment->setCommand(0, command);
      environment->step();
      turned_rad += odometry().turn_radps * 0.1;
    }
  }
  Odometry odometry() const { return std::get<Odometry>(environment->state().readings[0].measurements[0]); }
  const TPose2D& measured() { return (last_ = odometry()).odom_from_robot; }
  const TPose2D& truth() const { return environment->state().world_from_robot[0]; }

  std::unique_ptr<Environment> environment;
  double turned_rad = 0;  ///< by odometry

 private:
  Odometry last_;
};

void expectPoseNear(const TPose2D& pose, double x, double y, double heading) {
  EXPECT_NEAR(pose.x, x, 1e-9);
  EXPECT_NEAR(pose.y, y, 1e-9);
  EXPECT_NEAR(std::remainder(pose.phi - heading, 2 * M_PI), 0, 1e-9);
}

WheelErrors errorsOf(double WheelErrors::*error, double value) {
  WheelErrors errors;
  errors.*error = value;
  return errors;
}

constexpr Drive kMecanum{.kind = DriveKind::omni};

TEST(MecanumSquare, ClosesWhateverTheRollersSlip) {
  MeasuredRobot robot(kMecanum, errorsOf(&WheelErrors::lateral_slip, 0.1));
  robot.drive({.speed_mps = 1}, 20);
  robot.drive({.lateral_mps = 1}, 20);
  expectPoseNear(robot.measured(), 2, 2.2, 0);  // at the far corner it shows
  robot.drive({.speed_mps = -1}, 20);
  robot.drive({.lateral_mps = -1}, 20);
  expectPoseNear(robot.measured(), 0, 0, 0);
  expectPoseNear(robot.truth(), 0, 0, 0);
}

TEST(MecanumSquare, DoesNotCloseWithUnequalWheelsAndItsErrorsChangeSignWithItsDirection) {
  // E_d = 1.25 turns the odometry of 2 m ahead by 2 · (0.9 - 1.125) / W = -0.45 rad for W = 1 m, and of 2 m back by as
  // much in return. The wheels' mean is 1.0125. One side of 2.025 m is thus turned against the one opposite.
  const double turn_rad = -0.45, side_m = 2.025;
  WheelErrors wheels = errorsOf(&WheelErrors::diameter_ratio, 1.25);
  wheels.wheelbase_m = 1;
  MeasuredRobot left(kMecanum, wheels);  // counter-clockwise
  left.drive({.speed_mps = 1}, 20);
  left.drive({.lateral_mps = 1}, 20);
  left.drive({.speed_mps = -1}, 20);
  left.drive({.lateral_mps = -1}, 20);
  expectPoseNear(left.truth(), 0, 0, 0);
  expectPoseNear(left.measured(), -side_m * std::sin(turn_rad), side_m * (std::cos(turn_rad) - 1), 0);
  MeasuredRobot right(kMecanum, wheels);  // the same corners in the other order
  right.drive({.lateral_mps = 1}, 20);
  right.drive({.speed_mps = 1}, 20);
  right.drive({.lateral_mps = -1}, 20);
  right.drive({.speed_mps = -1}, 20);
  expectPoseNear(right.truth(), 0, 0, 0);
  expectPoseNear(right.measured(), side_m * std::sin(turn_rad), side_m * (1 - std::cos(turn_rad)), 0);
}

constexpr Drive kAckermann{.kind = DriveKind::car, .wheelbase_m = 0.5, .steering_max_rad = 45 * kRadPerDeg};

/// Turn by odometry of a full circle of 1 m, by its real turn. @param side 1: counter-clockwise, -1: clockwise
double turnOfCircle(const WheelErrors& errors, int side) {
  MeasuredRobot robot(kAckermann, errors);
  robot.drive({.speed_mps = M_PI / 4, .turn_radps = side * M_PI / 4}, 80);
  expectPoseNear(robot.truth(), 0, 0, 0);
  return robot.turned_rad / (side * 2 * M_PI);
}

TEST(CarCircles, ToBothSidesSeparateTheOffsetOfTheSteeringFromTheWheelbase) {
  // The wheels are steered by atan(0.5 m / 1 m) and 0.1 more is measured, as tangents:
  // (0.5 + 0.1) / (1 - 0.05) / 0.5 to the left, and (0.5 - 0.1) / (1 + 0.05) / 0.5 to the right.
  const WheelErrors offset = errorsOf(&WheelErrors::steering_offset_rad, std::atan(0.1));
  EXPECT_NEAR(turnOfCircle(offset, 1), 0.6 / 0.95 / 0.5, 1e-9);
  EXPECT_NEAR(turnOfCircle(offset, -1), 0.4 / 1.05 / 0.5, 1e-9);
  const WheelErrors wheelbase = errorsOf(&WheelErrors::wheelbase_ratio, 1.02);
  EXPECT_NEAR(turnOfCircle(wheelbase, 1), 1.02, 1e-9);
  EXPECT_NEAR(turnOfCircle(wheelbase, -1), 1.02, 1e-9);
}

TEST(CarCircles, MakeAFigureOfEightThatClosesWithoutErrorsOnly) {
  const auto end = [](const WheelErrors& errors) {
    MeasuredRobot robot(kAckermann, errors);
    robot.drive({.speed_mps = M_PI / 4, .turn_radps = M_PI / 4}, 80);
    robot.drive({.speed_mps = M_PI / 4, .turn_radps = -M_PI / 4}, 80);
    expectPoseNear(robot.truth(), 0, 0, 0);
    return robot.turned_rad;
  };
  EXPECT_NEAR(end({}), 0, 1e-9);
  EXPECT_NEAR(end(errorsOf(&WheelErrors::wheelbase_ratio, 1.02)), 0, 1e-9) << "the two circles cancel";
  EXPECT_NEAR(end(errorsOf(&WheelErrors::steering_offset_rad, std::atan(0.1))),
              2 * M_PI * (0.6 / 0.95 - 0.4 / 1.05) / 0.5, 1e-9);
}

TEST(TurnsOnTheSpot, ShowTheTrackFactorThatTracksAreThoughtToHave) {
  // Commanded and, by odometry, driven: 5 turns. The robot makes 1.2 / 1.5 of them.
  const Drive drive{.kind = DriveKind::tracked, .track_factor = 1.5, .assumed_factor = 1.2};
  MeasuredRobot robot(drive, {});
  robot.drive({.turn_radps = M_PI / 4}, 400);
  EXPECT_NEAR(robot.turned_rad, 10 * M_PI, 1e-9);
  expectPoseNear(robot.truth(), 0, 0, 8 * M_PI);
  expectPoseNear(robot.measured(), 0, 0, 10 * M_PI);
}

TEST(TurnsOnTheSpot, MoveARobotSidewaysThatTurnsAboutAnotherPointWhichTracksDoNotMeasure) {
  // Half a turn about a point 0.1 m behind the origin.
  const Drive drive{.kind = DriveKind::tracked, .icr_x_m = -0.1};
  MeasuredRobot robot(drive, {});
  robot.drive({.turn_radps = M_PI / 4}, 40);
  expectPoseNear(robot.truth(), -0.2, 0, M_PI);
  expectPoseNear(robot.measured(), 0, 0, M_PI);
  robot.drive({.turn_radps = M_PI / 4}, 40);
  expectPoseNear(robot.truth(), 0, 0, 0);
}

}  // namespace
}  // namespace robosim
