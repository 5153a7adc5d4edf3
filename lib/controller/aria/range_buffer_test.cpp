#include "aria/range_buffer.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "base/angle_units.h"

namespace robosim {
namespace {

TEST(RangeBuffer, DropsItsOldestPoints) {
  RangeBuffer buffer(2);
  for (int i = 1; i <= 3; ++i) buffer.addReading({.x = i * 100.0, .y = 0, .time_s = i * 0.1});
  ASSERT_EQ(buffer.getBuffer().size(), 2u);
  EXPECT_EQ(buffer.getBuffer()[0].getX(), 300);  // newest first
  EXPECT_EQ(buffer.getBuffer()[1].getX(), 200);
  buffer.setSize(1);
  ASSERT_EQ(buffer.getBuffer().size(), 1u);
  EXPECT_EQ(buffer.getBuffer()[0].getX(), 300);
}

TEST(RangeBuffer, KeepsNothingWithSizeZero) {
  RangeBuffer buffer(0);
  buffer.addReading({});
  EXPECT_TRUE(buffer.getBuffer().empty());
}

TEST(RangeBuffer, ForgetsByAgeAndDistance) {
  RangeBuffer buffer(9);
  buffer.addReading({.x = 1000, .y = 0, .time_s = 1});
  buffer.addReading({.x = 2000, .y = 0, .time_s = 2});
  buffer.addReading({.x = 3000, .y = 0, .time_s = 3});
  buffer.clearOlderThan(2);
  EXPECT_EQ(buffer.getBuffer().size(), 2u);
  buffer.clearFartherThan({.x = 1000, .y = 0, .th = 0}, 1000);
  ASSERT_EQ(buffer.getBuffer().size(), 1u);
  EXPECT_EQ(buffer.getBuffer()[0].getX(), 2000);
}

TEST(RangeBuffer, ReplacesNearPoints) {
  RangeBuffer buffer(9);
  buffer.addReading({.x = 0, .y = 0, .time_s = 0});
  buffer.addReading({.x = 100, .y = 0, .time_s = 0});
  EXPECT_TRUE(buffer.hasPointNear(30, 40, 51));
  EXPECT_FALSE(buffer.hasPointNear(30, 40, 50));
  buffer.replaceNear({.x = 30, .y = 40, .time_s = 1}, 51);  // 50 mm from the first, 81 mm from the second
  ASSERT_EQ(buffer.getBuffer().size(), 2u);
  EXPECT_EQ(buffer.getBuffer()[0], (RangePoint{.x = 30, .y = 40, .time_s = 1}));
  EXPECT_EQ(buffer.getBuffer()[1].getX(), 100);
}

TEST(RangeBuffer, FindsTheClosestPointOfASectorInTheRobotsFrame) {
  RangeBuffer buffer(9);
  buffer.addReading({.x = 1000, .y = 3000, .time_s = 0});  // ahead of the robot below
  buffer.addReading({.x = 0, .y = 1000, .time_s = 0});     // on its left
  const PioneerPose robot{.x = 1000, .y = 1000, .th = 90};
  const auto ahead = buffer.getClosestPolar(-30, 30, robot);
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->distance, 2000, 1e-9);
  EXPECT_NEAR(ahead->angle, 0, 1e-9);
  EXPECT_NEAR(ahead->local.x, 2000, 1e-9);
  const auto left = buffer.getClosestPolar(-180, 180, robot);
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->distance, 1000, 1e-9);
  EXPECT_NEAR(left->angle, 90, 1e-9);
  EXPECT_FALSE(buffer.getClosestPolar(-120, -60, robot));
}

TEST(RangeBuffer, FindsTheClosestPointOfABoxInTheRobotsFrame) {
  RangeBuffer buffer(9);
  buffer.addReading({.x = 1000, .y = 3000, .time_s = 0});
  const PioneerPose robot{.x = 1000, .y = 1000, .th = 90};
  EXPECT_NEAR(buffer.getClosestBox(0, -100, 2500, 100, robot)->distance, 2000, 1e-9);
  EXPECT_NEAR(buffer.getClosestBox(2500, 100, 0, -100, robot)->distance, 2000, 1e-9);
  EXPECT_FALSE(buffer.getClosestBox(0, -100, 1900, 100, robot));
}

TEST(RangeBuffer, MovesItsPointsToAnotherFrame) {
  RangeBuffer buffer(9);
  buffer.addReading({.x = 100, .y = 0, .time_s = 7});
  buffer.applyTransform(PioneerTransform({.x = 0, .y = 0, .th = 0}, {.x = 1000, .y = 0, .th = 90}));
  EXPECT_NEAR(buffer.getBuffer()[0].x, 1000, 1e-9);
  EXPECT_NEAR(buffer.getBuffer()[0].y, 100, 1e-9);
  EXPECT_EQ(buffer.getBuffer()[0].time_s, 7);
}

/// Reference in plain floating point: signed angles are compared over all multiples of a turn.
bool isInSector(double deg, double from, double to) {
  while (to < from) to += 360;
  for (int turn = -3; turn <= 3; ++turn) {
    if (from <= deg + 360 * turn && deg + 360 * turn <= to) return true;
  }
  return false;
}

TEST(RangeBuffer, AgreesWithAPlainSearchOnRandomPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> mm(-4000, 4000), deg(-180, 180);
  for (int round = 0; round < 2000; ++round) {
    RangeBuffer buffer(20);
    for (int i = 0; i < 20; ++i) buffer.addReading({.x = mm(random), .y = mm(random), .time_s = 0});
    const PioneerPose robot{.x = mm(random), .y = mm(random), .th = deg(random)};
    const double from = deg(random), to = deg(random);
    const double x1 = mm(random), x2 = mm(random), y1 = mm(random), y2 = mm(random);
    double polar = 1e9, box = 1e9;
    for (const RangePoint& point : buffer.getBuffer()) {
      const double distance = std::hypot(point.x - robot.x, point.y - robot.y);
      const double bearing = std::atan2(point.y - robot.y, point.x - robot.x) - toRadians(robot.th);
      const double x = distance * std::cos(bearing), y = distance * std::sin(bearing);
      if (isInSector(toDegrees(bearing), from, to)) polar = std::min(polar, distance);
      if ((x - x1) * (x - x2) <= 0 && (y - y1) * (y - y2) <= 0) box = std::min(box, distance);
    }
    const auto found_polar = buffer.getClosestPolar(from, to, robot);
    const auto found_box = buffer.getClosestBox(x1, y1, x2, y2, robot);
    EXPECT_NEAR(found_polar ? found_polar->distance : 1e9, polar, 1e-6);
    EXPECT_NEAR(found_box ? found_box->distance : 1e9, box, 1e-6);
  }
}

TEST(RangeBuffer, TakesTheNearerOfTwoResults) {
  const ClosestPoint near{.distance = 1, .angle = 0, .local = {}}, far{.distance = 2, .angle = 0, .local = {}};
  EXPECT_EQ(nearerOf(near, far)->distance, 1);
  EXPECT_EQ(nearerOf(far, near)->distance, 1);
  EXPECT_EQ(nearerOf(far, std::nullopt)->distance, 2);
  EXPECT_EQ(nearerOf(std::nullopt, far)->distance, 2);
  EXPECT_FALSE(nearerOf(std::nullopt, std::nullopt));
}

}  // namespace
}  // namespace robosim
