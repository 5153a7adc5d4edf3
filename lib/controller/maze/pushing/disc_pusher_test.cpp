#include "maze/pushing/disc_pusher.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kDisc_m = 0.1;

/// A robot, and a disc that yields to it along the line through both centres, as on a floor with friction.
class DiscAndRobot {
 public:
  explicit DiscAndRobot(const TPoint2D& disc) : disc_(disc) {}

  /// Pushes for a time. @return whether the disc came as close to the target as 0.1 m
  bool pushTo(const TPoint2D& target, double time_s) {
    Robot robot(hardware_);
    for (int i = 0; i < 10 * time_s; ++i) {
      pushDisc(robot, pose(), {disc_, kDisc_m, target}, 0.3);
      hardware_.advance();
      const TPoint2D apart = disc_ - TPoint2D(pose().x, pose().y);
      const double distance_m = apart.norm(), contact_m = FakeHardware::kRadius_m + kDisc_m;
      if (distance_m < contact_m) disc_ = disc_ + apart * ((contact_m - distance_m) / distance_m);
      if ((disc_ - target).norm() < 0.1) return true;
    }
    return false;
  }
  const TPoint2D& disc() const { return disc_; }
  const mrpt::math::TPose2D& pose() const { return hardware_.odometry().odom_from_robot; }

 private:
  FakeHardware hardware_;
  TPoint2D disc_;
};

TEST(PushDisc, MovesADiscToATargetInAnyDirection) {
  for (int degrees = 0; degrees < 360; degrees += 15) {
    const double direction = degrees * std::numbers::pi / 180;
    DiscAndRobot pair({1, 0.2});
    const TPoint2D target = pair.disc() + TPoint2D(2 * std::cos(direction), 2 * std::sin(direction));
    EXPECT_TRUE(pair.pushTo(target, 60)) << degrees << "°: the disc is at " << pair.disc().asString();
  }
}

TEST(PushDisc, DoesNotTouchTheDiscOnTheWayRoundIt) {
  DiscAndRobot pair({1, 0});
  EXPECT_FALSE(pair.pushTo({-2, 0}, 4)) << "the robot is between disc and target";
  EXPECT_EQ(pair.disc(), TPoint2D(1, 0));
}

TEST(DriveTo, StopsAtThePlace) {
  FakeHardware hardware;
  Robot robot(hardware);
  bool is_there = false;
  for (int i = 0; i < 200 && !is_there; ++i) {
    is_there = driveTo(robot, hardware.odometry().odom_from_robot, {-1, 1}, 0.5, 0.05);
    hardware.advance();
  }
  EXPECT_TRUE(is_there);
  EXPECT_EQ(robot.command().speed_mps, 0);
  EXPECT_LT(TPoint2D(hardware.odometry().odom_from_robot.x + 1, hardware.odometry().odom_from_robot.y - 1).norm(), 0.1);
}

}  // namespace
}  // namespace robosim
