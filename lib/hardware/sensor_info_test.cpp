#include "hardware/sensor_info.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(SensorKind, HasANameOfItsOwnForEveryKind) {
  std::set<std::string> names;
  for (const auto kind : {SensorKind::sonar, SensorKind::laser, SensorKind::infrared, SensorKind::heat,
                          SensorKind::bumper, SensorKind::odometry, SensorKind::compass}) {
    names.insert(nameOf(kind));
  }
  EXPECT_EQ(names, (std::set<std::string>{"sonar", "laser", "infrared", "heat", "bumper", "odometry", "compass"}));
}

}  // namespace
}  // namespace robosim
