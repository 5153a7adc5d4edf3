#include "hardware/sensor_info.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(SensorKind, HasAUniqueNameForEveryKind) {
  EXPECT_EQ(std::string(nameOf(SensorKind::sonar)), "sonar");
  EXPECT_EQ(std::string(nameOf(SensorKind::blob_finder)), "blob_finder");
  EXPECT_EQ(sensorKindNamed("battery"), SensorKind::battery);
  EXPECT_EQ(sensorKindNamed("thermometer"), std::nullopt);
  for (std::size_t i = 0; i < kSensorKindNames.size(); ++i) {
    EXPECT_EQ(sensorKindNamed(kSensorKindNames[i]), static_cast<SensorKind>(i)) << kSensorKindNames[i];
  }
}

TEST(Beam, TurnsWithThePanAndKeepsItsElevation) {
  // 30° upwards; MRPT's pitch is positive downwards.
  const Beam beam{mrpt::math::TPose3D(1, 2, 3, 0, -M_PI / 6, 0)};
  const double level = std::sqrt(0.75);
  const auto expect_direction = [&](double pan_rad, double x, double y) {
    const auto direction = directionOf(beam, pan_rad);
    EXPECT_NEAR(direction.x, x, 1e-15) << pan_rad;
    EXPECT_NEAR(direction.y, y, 1e-15) << pan_rad;
    EXPECT_NEAR(direction.z, 0.5, 1e-15) << pan_rad;
  };
  expect_direction(0, level, 0);
  expect_direction(M_PI / 2, 0, level);
  expect_direction(-M_PI / 2, 0, -level);
}

TEST(CameraInfo, HasAFocalLengthOfHalfTheWidthAt90Degrees) {
  EXPECT_NEAR((CameraInfo{320, 240, M_PI / 2, 10}).focalLength(), 160, 1e-12);
}

}  // namespace
}  // namespace robosim
