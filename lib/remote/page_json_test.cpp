#include "remote/page_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace robosim {
namespace {

using Json = nlohmann::json;

TEST(PageJson, HasTheNumbersOfEachKindOfMeasurement) {
  RobotInfo robot;
  std::vector<SensorInfo> sensors(7);
  const SensorKind kinds[] = {SensorKind::sonar,   SensorKind::compass, SensorKind::bumper, SensorKind::odometry,
                              SensorKind::beacons, SensorKind::values,  SensorKind::camera};
  for (std::size_t i = 0; i < sensors.size(); ++i) sensors[i].kind = kinds[i];
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(sensors);
  RobotUpdate update;
  update.readings.measurements = {Echoes{{1.2344f, {1, 2, 3}}, {2, {}}},
                                  Scalar{-0.5},
                                  Contacts{{0, 1}},
                                  Odometry{{1, 2, 0.5}, 0.25, -1},
                                  BeaconRanges{{2.5f, 50}},
                                  Values{{412.5}},
                                  Image{"a file"}};
  const Json measurements = Json::parse(updateJson(robot, update, nullptr, true))["measurements"];
  EXPECT_EQ(measurements, Json::parse(R"([[1234, 2000], -0.5, [0, 1],
      {"x_m": 1.0, "y_m": 2.0, "heading_rad": 0.5, "speed_mps": 0.25, "turn_radps": -1.0},
      [2.5, 50.0], [412.5], null])"));
}

TEST(PageJson, HasRangesAndHeatOnRequestOnly) {
  RobotInfo robot;
  std::vector<SensorInfo> sensors(3);
  sensors[0].kind = SensorKind::sonar;
  sensors[1].kind = SensorKind::heat;
  sensors[2].kind = SensorKind::compass;
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(sensors);
  RobotUpdate update;
  update.readings.measurements = {Echoes{{1, {}}}, Scalar{7}, Scalar{0.5}};
  const Json measurements = Json::parse(updateJson(robot, update, nullptr, false))["measurements"];
  EXPECT_EQ(measurements, Json::parse("[null, null, 0.5]"));
}

}  // namespace
}  // namespace robosim
