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

TEST(CameraInfo, HasAFocalLengthOfHalfTheWidthAt90Degrees) {
  EXPECT_NEAR((CameraInfo{320, 240, M_PI / 2, 10}).focalLength(), 160, 1e-12);
}

}  // namespace
}  // namespace robosim
