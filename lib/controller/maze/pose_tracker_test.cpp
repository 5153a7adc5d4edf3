#include "maze/pose_tracker.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

/// A FakeHardware with a compass.
struct WithCompass {
  WithCompass() {
    auto sensors = *hardware.info().sensors;
    sensors.emplace_back().kind = SensorKind::compass;
    hardware.mutableInfo().sensors = std::make_shared<std::vector<SensorInfo>>(sensors);
    hardware.mutableReadings().measurements.emplace_back(Scalar{});
  }
  void point(double compass_rad) {
    std::get<Scalar>(hardware.mutableReadings().measurements.back()).value = compass_rad;
  }
  FakeHardware hardware;
};

TEST(PoseTracker, StartsAtZeroForAnyOdometry) {
  FakeHardware hardware;
  const Robot robot(hardware);
  hardware.mutableOdometry().odom_from_robot = {3, 4, M_PI / 2};
  PoseTracker tracker;
  EXPECT_NEAR(tracker.update(robot).x, 0, 1e-12);
  hardware.mutableOdometry().odom_from_robot = {3, 5, M_PI};  // 1 m ahead, then 90° to the left
  tracker.update(robot);
  EXPECT_NEAR(tracker.startFromRobot().x, 1, 1e-12);
  EXPECT_NEAR(tracker.startFromRobot().y, 0, 1e-12);
  EXPECT_NEAR(tracker.startFromRobot().phi, M_PI / 2, 1e-12);
}

TEST(PoseTracker, FollowsTheOdometryWithoutACompass) {
  FakeHardware hardware;
  Robot robot(hardware);
  PoseTracker tracker;
  robot.drive(0.5, 0.3);
  for (int i = 0; i < 100; ++i) {
    tracker.update(robot);
    hardware.advance();
  }
  tracker.update(robot);
  EXPECT_NEAR(tracker.startFromRobot().x, hardware.odometry().odom_from_robot.x, 1e-9);
  EXPECT_NEAR(tracker.startFromRobot().y, hardware.odometry().odom_from_robot.y, 1e-9);
}

TEST(PoseTracker, CorrectsDriftOfTheHeadingByTheCompass) {
  // The odometry adds 0.001 rad in each step to a straight path: 57° over 1000 steps.
  WithCompass w;
  const Robot robot(w.hardware);
  Rng rng(5);
  PoseTracker tracker;
  for (int i = 0; i <= 1000; ++i) {
    w.hardware.mutableOdometry().odom_from_robot.phi = 0.001 * i;
    w.point(mrpt::math::wrapToPi(3.1 + (i == 0 ? 0 : 0.03 * rng.gaussian())));
    tracker.update(robot);
  }
  EXPECT_NEAR(tracker.startFromRobot().phi, 0.05, 0.02);  // the filter lags by the drift of 1 / 0.02 steps
}

TEST(PoseTracker, FollowsTheCompassAcrossPi) {
  WithCompass w;
  const Robot robot(w.hardware);
  PoseTracker tracker;
  for (int i = 0; i <= 200; ++i) {
    const double phi = mrpt::math::wrapToPi(0.05 * i);
    w.hardware.mutableOdometry().odom_from_robot.phi = phi;
    w.point(mrpt::math::wrapToPi(2 + 0.05 * i));
    tracker.update(robot);
    EXPECT_NEAR(mrpt::math::wrapToPi(tracker.startFromRobot().phi - phi), 0, 1e-9);
  }
}

}  // namespace
}  // namespace robosim
