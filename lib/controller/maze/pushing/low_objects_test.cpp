#include "maze/pushing/low_objects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// A robot with two scanners of 180 beams, one above the other, without echoes.
class TwoScanners : public testing::Test {
 protected:
  TwoScanners() {
    std::vector<double> yaws;
    for (int i = 0; i < 180; ++i) yaws.push_back(std::numbers::pi * (i - 90) / 90);
    low_ = hardware_.addSensor(SensorKind::laser, yaws, Echoes(180));
    high_ = hardware_.addSensor(SensorKind::laser, yaws, Echoes(180));
    auto sensors = std::make_shared<std::vector<SensorInfo>>(*hardware_.info().sensors);
    (*sensors)[low_].label = kLowLaser;
    (*sensors)[high_].label = kHighLaser;
    for (const std::size_t slot : {low_, high_}) (*sensors)[slot].range_max_m = (*sensors)[slot].no_echo_m = 5;
    hardware_.mutableInfo().sensors = sensors;
    for (std::size_t beam = 0; beam < 180; ++beam) {
      for (const std::size_t slot : {low_, high_}) hardware_.setRange(slot, beam, 1e9);
    }
  }

  /// Lets beams end at a disc, of the lower scanner only, or of both.
  void addDisc(const TPoint2D& center, double radius_m, bool is_low) {
    for (std::size_t beam = 0; beam < 180; ++beam) {
      const double yaw = std::numbers::pi * (static_cast<double>(beam) - 90) / 90;
      const double along = center.x * std::cos(yaw) + center.y * std::sin(yaw);
      const double aside = center.y * std::cos(yaw) - center.x * std::sin(yaw);
      if (along < 0 || std::abs(aside) >= radius_m) continue;
      const double range_m = along - std::sqrt(radius_m * radius_m - aside * aside);
      for (const std::size_t slot : {low_, high_}) {
        const double before_m = std::get<Echoes>(hardware_.readings().measurements[slot])[beam].range_m;
        if ((slot == low_ || !is_low) && range_m < before_m) hardware_.setRange(slot, beam, range_m);
      }
    }
  }

  FakeHardware hardware_;
  std::size_t low_ = 0, high_ = 0;
};

TEST_F(TwoScanners, DetectLowObjectsAndNoRobots) {
  addDisc({1, 0.5}, 0.1, true);
  addDisc({-2, 0}, 0.25, false);
  const auto centers = lowObjects(Robot(hardware_), 0.1);
  ASSERT_EQ(centers.size(), 1u);
  EXPECT_NEAR(centers[0].x, 1, 0.02);
  EXPECT_NEAR(centers[0].y, 0.5, 0.02);
}

TEST_F(TwoScanners, DistinguishObjectsInContactTheNearestFirst) {
  addDisc({1.2, 0.21}, 0.1, true);
  addDisc({1, 0}, 0.1, true);
  addDisc({0, -0.8}, 0.1, true);
  const auto centers = lowObjects(Robot(hardware_), 0.1);
  ASSERT_EQ(centers.size(), 3u);
  EXPECT_NEAR(centers[0].y, -0.8, 0.02);
  EXPECT_NEAR(centers[1].x, 1, 0.02);
  EXPECT_NEAR(centers[2].x, 1.2, 0.05);
  EXPECT_NEAR(centers[2].y, 0.21, 0.05);
}

TEST_F(TwoScanners, DoNotDetectALowObjectBehindARobot) {
  addDisc({1, 0}, 0.25, false);
  addDisc({2, 0}, 0.1, true);
  EXPECT_TRUE(lowObjects(Robot(hardware_), 0.1).empty());
}

TEST(LowObjects, AreNoneForARobotWithoutTheScanners) {
  FakeHardware hardware;
  EXPECT_TRUE(lowObjects(Robot(hardware), 0.1).empty());
}

}  // namespace
}  // namespace robosim
