#include "console/page_json.h"

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
                                  Odometry{{1, 2, 0.5}, 0.25, -1, 0.5},
                                  BeaconRanges{{2.5f, 50}},
                                  Values{{412.5}},
                                  Image{"a file"}};
  const Json measurements = Json::parse(updateJson(robot, update, nullptr, true))["measurements"];
  EXPECT_EQ(measurements, Json::parse(R"([[1234, 2000], -0.5, [0, 1],
      {"x_m": 1.0, "y_m": 2.0, "heading_rad": 0.5, "speed_mps": 0.25, "turn_radps": -1.0, "lateral_mps": 0.5},
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

TEST(PageJson, HasHeatAndStallOfEveryConnectedRobot) {
  std::vector<SensorInfo> sensors(1);
  sensors[0].kind = SensorKind::heat;
  RobotInfo info;
  info.sensors = std::make_shared<const std::vector<SensorInfo>>(sensors);
  std::vector<TeamRobot> team(4);
  const char* names[] = {"Ann", "Bob", "Cid", "Dan"};
  for (std::size_t i = 0; i < team.size(); ++i) {
    team[i].name = names[i];
    team[i].news.is_up = i < 3;
    team[i].news.info = std::make_shared<const RobotInfo>(info);
  }
  RobotUpdate update;  // of the primary
  update.readings.time = {20, 0.1};
  update.readings.measurements = {Scalar{7.26}};
  team[0].news.update = std::make_shared<const RobotUpdate>(update);
  RobotAnswer answer{.step = 19, .sensor = 0, .has_sensor = true, .measurement = Scalar{1.5}};
  team[0].news.answers[0] = std::make_shared<const RobotAnswer>(answer);  // older than the update
  team[1].news.answers[0] = std::make_shared<const RobotAnswer>(answer);
  team[1].news.state.set_stalled(true);
  EXPECT_EQ(Json::parse(vitalsJson(team)), Json::parse(R"({"type": "vitals", "robots": {
      "Ann": {"heat": 7.3, "stalled": false}, "Bob": {"heat": 1.5, "stalled": true},
      "Cid": {"heat": null, "stalled": false}}})"));
}

TEST(PageJson, HasTheWinnersDistanceAlsoIfItIsNotThePrimary) {
  std::vector<TeamRobot> team(2);
  team[0].name = "Ann";
  team[1].name = "Bob";
  for (auto& robot : team) {
    robot.news.is_up = true;
    robot.news.state.set_driven_m(3);
  }
  const auto distance = [&] { return Json::parse(teamJson(team, {}))["winner_driven_m"]; };
  EXPECT_EQ(distance(), nullptr) << "there is no winner";
  for (auto& robot : team) robot.news.state.set_winner("Bob");
  team[1].news.state.set_driven_m(12.25);
  EXPECT_EQ(distance(), 12.25);
  team[1].news.state.clear_driven_m();
  EXPECT_EQ(distance(), nullptr) << "it has no odometry";
  for (auto& robot : team) robot.news.state.set_winner("Cid");
  EXPECT_EQ(distance(), nullptr) << "it is not in the team";
}

TEST(PageJson, HasTheColoursOfRobots) {
  std::vector<TeamRobot> team(2);
  RobotInfo info;
  info.color_rgb = 0x01abF0;
  team[0].news.info = std::make_shared<const RobotInfo>(info);
  const Json robots = Json::parse(teamJson(team, {}))["robots"];
  EXPECT_EQ(robots[0]["color"], "#01abf0");
  EXPECT_EQ(robots[1]["color"], "");
}

}  // namespace
}  // namespace robosim
