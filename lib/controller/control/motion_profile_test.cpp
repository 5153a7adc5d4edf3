#include "control/motion_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(MotionProfile, ChangesSpeedWithinItsLimits) {
  const AxisLimits limits{.speed_max = 1, .accel = 2, .decel = 4};
  EXPECT_DOUBLE_EQ(speedTowards(1, 0, limits, 0.1), 0.2);   // 2 m/s² for 0.1 s
  EXPECT_DOUBLE_EQ(speedTowards(0, 1, limits, 0.1), 0.6);   // 4 m/s² for 0.1 s
  EXPECT_DOUBLE_EQ(speedTowards(5, 0.95, limits, 0.1), 1);  // never above the highest speed
  EXPECT_DOUBLE_EQ(speedTowards(-1, 0.1, limits, 0.1), 0);  // to rest before it turns round
  EXPECT_DOUBLE_EQ(speedTowards(-1, 0, limits, 0.1), -0.2);
}

TEST(MotionProfile, SlowsDownSoThatItStopsAtTheTarget) {
  for (const double to_go : {0.001, 0.03, 0.5, -2.0}) {
    double left = to_go, last = 1e9;
    for (int i = 0; i < 100; ++i) {
      const double speed = speedToStopAfter(left, 0.8, 0.1);
      EXPECT_GE(speed * to_go, 0);
      if (i > 0) {
        EXPECT_LE(std::abs(last - speed), 0.08 + 1e-9);
      }
      left -= speed * 0.1;
      EXPECT_GE(left * to_go, -1e-12) << "overshoots from " << to_go;
      last = speed;
    }
    EXPECT_NEAR(left, 0, 1e-9);
  }
}

struct Driven {
  FakeHardware hardware;
  Robot robot{hardware};
  ProfiledDrive drive{robot};

  void steps(int n) {
    for (int i = 0; i < n; ++i) {
      hardware.advance();
      drive.update();
    }
  }
  const mrpt::math::TPose2D& pose() const { return hardware.odometry().odom_from_robot; }
};

TEST(ProfiledDrive, DrivesATrapezoid) {
  Driven d;
  d.drive.moveBy(4);
  double highest = 0;
  for (int i = 0; i < 80; ++i) {
    d.steps(1);
    highest = std::max(highest, d.hardware.odometry().speed_mps);
  }
  EXPECT_DOUBLE_EQ(highest, 1);      // it reaches its cruising speed,
  EXPECT_NEAR(d.pose().x, 4, 1e-6);  // and still stops where it should
  EXPECT_NEAR(d.drive.wayToGo(), 0, 1e-6);
}

TEST(ProfiledDrive, TakesAsLongAsATrapezoidTakes) {
  // 4 m with 0.5 m/s² up to 1 m/s (2 s, 1 m), 1 m/s² down (1 s, 0.5 m), 2.5 m between at 1 m/s: 5.5 s. The speed moves
  // in steps of 0.1 s, which costs or gains about one step at either end.
  Driven d;
  d.drive.moveBy(4);
  int steps = 0;
  while (d.drive.wayToGo() > 0.01 && steps < 200) {
    d.steps(1);
    ++steps;
  }
  EXPECT_NEAR(steps, 55, 2);
}

TEST(ProfiledDrive, MovesBackwards) {
  Driven d;
  d.drive.moveBy(-0.7);
  d.steps(60);
  EXPECT_NEAR(d.pose().x, -0.7, 1e-6);
}

TEST(ProfiledDrive, TurnsToAHeadingByTheSmallerAngle) {
  Driven d;
  d.hardware.mutableOdometry().odom_from_robot.phi = 3;
  d.drive.update();
  d.drive.turnTo(-3);
  EXPECT_GT(d.drive.turnToGo(), 0);  // counter-clockwise over π: 0.28 rad instead of 6
  d.steps(40);
  EXPECT_NEAR(d.pose().phi, -3, 1e-6);
}

TEST(ProfiledDrive, TurnsMoreThanOnceRound) {
  Driven d;
  d.drive.turnBy(3 * kPi);
  double turned = 0, last = 0;
  for (int i = 0; i < 120; ++i) {
    d.steps(1);
    turned += mrpt::math::wrapToPi(d.pose().phi - last);
    last = d.pose().phi;
  }
  EXPECT_NEAR(turned, 3 * kPi, 1e-6);
}

TEST(ProfiledDrive, MeasuresAnArcByItsLength) {
  Driven d;
  d.drive.setTurn(0.5);
  d.drive.moveBy(2);
  double driven = 0;
  for (int i = 0; i < 80; ++i) {
    d.steps(1);
    driven += d.hardware.odometry().speed_mps * 0.1;
  }
  EXPECT_NEAR(driven, 2, 1e-3);
}

TEST(ProfiledDrive, KeepsDrivingWhileBlocked) {
  Driven d;
  d.drive.moveBy(1);
  d.hardware.blocked = true;
  d.steps(50);
  EXPECT_DOUBLE_EQ(d.drive.wayToGo(), 1);
  d.hardware.blocked = false;
  d.steps(50);
  EXPECT_NEAR(d.pose().x, 1, 1e-6);
}

TEST(ProfiledDrive, ClampsLimitsToTheHardware) {
  Driven d;
  d.drive.limitWay({.speed_max = 50, .accel = 0.2, .decel = -1});
  EXPECT_DOUBLE_EQ(d.drive.wayLimits().speed_max, 1);
  EXPECT_DOUBLE_EQ(d.drive.wayLimits().accel, 0.2);
  EXPECT_DOUBLE_EQ(d.drive.wayLimits().decel, 1);
}

TEST(ProfiledDrive, StandsWhileItIsDisabled) {
  Driven d;
  d.drive.setSpeed(1);
  d.drive.enable(false);
  d.steps(20);
  EXPECT_EQ(d.pose().x, 0);
  d.drive.enable(true);
  d.steps(20);
  EXPECT_GT(d.pose().x, 0);
}

TEST(ProfiledDrive, NamesTheRobotWithoutOdometry) {
  FakeHardware hardware;
  hardware.mutableInfo().sensors = std::make_shared<std::vector<SensorInfo>>();
  hardware.mutableReadings().measurements.clear();
  Robot robot(hardware);
  try {
    ProfiledDrive drive(robot);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "robot 'fake' has no odometry, by which moves are measured; add <odometry/> to its model");
  }
}

}  // namespace
}  // namespace robosim
