#include "hardware/sensor_info.h"

#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(SensorKind, HasANameOfItsOwnForEveryKind) {
  std::set<std::string> names;
  for (const auto kind :
       {SensorKind::sonar, SensorKind::laser, SensorKind::infrared, SensorKind::heat, SensorKind::bumper,
        SensorKind::odometry, SensorKind::compass, SensorKind::camera, SensorKind::blob_finder}) {
    names.insert(nameOf(kind));
  }
  EXPECT_EQ(names, (std::set<std::string>{"sonar", "laser", "infrared", "heat", "bumper", "odometry", "compass",
                                          "camera", "blob_finder"}));
}

TEST(CameraInfo, AFieldOfViewOf90DegreesHasThePicturesPlaneHalfItsWidthAway) {
  EXPECT_NEAR((CameraInfo{320, 240, M_PI / 2, 10}).focalLength_px(), 160, 1e-12);
}

}  // namespace
}  // namespace robosim
