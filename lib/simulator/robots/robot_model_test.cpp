#include "robots/robot_model.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/xml_parser.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

const std::filesystem::path kTypesFolder = ROBOSIM_SOURCE_DIR "/worlds/robots";

const std::string kBody = "<body radius_m='0.2' height_m='0.4'/>";
const std::string kLimits =
    "<limits speed_max_mps='1' accel_mps2='2' decel_mps2='3' turn_max_degps='90' turn_accel_degps2='180'/>";

RobotModel shipped(const std::string& name) {
  ErrorList errors;
  RobotModel model = readRobotModel(kTypesFolder / (name + ".xml"), errors);
  EXPECT_EQ(errors.errors(), Lines{});
  return model;
}

RobotModel parsed(const std::string& inner, const RobotDescription& description = {}) {
  ErrorList errors;
  RobotModel model = modelOf(parseXml("<robot name='r'>" + inner + "</robot>", ""), "r.xml", description, errors);
  EXPECT_EQ(errors.errors(), Lines{});
  return model;
}

Lines faultsOf(const std::string& text) {
  ErrorList errors;
  modelOf(parseXml(text, ""), "r.xml", {}, errors);
  return errors.errors();
}

Lines labelsOf(const RobotModel& model) {
  Lines labels;
  for (const auto& info : *model.sensor_infos) labels.push_back(info.label);
  return labels;
}

std::vector<XmlElement> elements(const std::string& text) { return parseXml("<a>" + text + "</a>", "").children; }

TEST(RobotModel, PioneerHasTheRealRobotsSonarsAndLimits) {
  const RobotModel model = shipped("pioneer3dx");
  EXPECT_EQ(model.type->model, "pioneer3dx");
  EXPECT_EQ(model.radius_m, 0.267);
  EXPECT_EQ(model.body.heights(), (HeightSpan{0, 0.237}));
  EXPECT_EQ(model.type->limits.speed_max_mps, 1);
  EXPECT_NEAR(model.type->limits.turn_max_radps, 1.74, 1e-3);
  EXPECT_EQ(model.type->limits.accel_mps2, 0.3);
  EXPECT_EQ(model.type->limits.decel_mps2, 0.3);
  EXPECT_EQ(model.type->limits.emergency_decel_mps2, 2);
  EXPECT_DOUBLE_EQ(model.type->limits.turn_accel_radps2, 100 * kRadPerDeg);
  EXPECT_EQ(labelsOf(model), (Lines{"sonar", "laser", "heat", "bumper", "odometry", "compass"}));

  const SensorInfo& sonar = model.sensor_infos->at(0);
  ASSERT_EQ(sonar.beams.size(), 16u);
  EXPECT_EQ(sonar.range_max_m, 5);
  EXPECT_EQ(sonar.no_echo_m, 5);
  // Left and right halves mirror each other: 0 and 7, 1 and 6, …; 8 and 15, 9 and 14, …
  for (std::size_t i = 0; i < 8; ++i) {
    const auto& left = sonar.beams[i < 4 ? i : 19 - i].robot_from_beam;
    const auto& right = sonar.beams[i < 4 ? 7 - i : 4 + i].robot_from_beam;
    EXPECT_GT(left.y, 0);
    EXPECT_EQ(left.x, right.x);
    EXPECT_EQ(left.y, -right.y);
    EXPECT_DOUBLE_EQ(left.yaw, -right.yaw);
  }
  EXPECT_EQ(sonar.beams[0].robot_from_beam.x, 0.069);
  EXPECT_EQ(sonar.beams[0].robot_from_beam.y, 0.136);
  EXPECT_DOUBLE_EQ(sonar.beams[0].robot_from_beam.yaw, 90 * kRadPerDeg);
  EXPECT_EQ(sonar.beams[11].robot_from_beam.x, -0.255);
  EXPECT_DOUBLE_EQ(sonar.beams[11].robot_from_beam.yaw, -170 * kRadPerDeg);

  const SensorInfo& laser = model.sensor_infos->at(1);
  ASSERT_EQ(laser.beams.size(), 181u);
  EXPECT_EQ(laser.beams[90].robot_from_beam.x, 0.018);
  EXPECT_NEAR(laser.beams[0].robot_from_beam.yaw, -M_PI / 2, 1e-12);
  EXPECT_EQ(laser.range_max_m, 8);
}

TEST(RobotModel, PolaroidPioneerDiffersFromTheOtherOneByItsSonarsOnly) {
  const RobotModel real = shipped("pioneer3dx_polaroid"), plain = shipped("pioneer3dx");
  EXPECT_EQ(labelsOf(real), labelsOf(plain));
  EXPECT_EQ(real.radius_m, plain.radius_m);
  for (std::size_t i = 0; i < real.sensors.size(); ++i) EXPECT_EQ(real.sensors[i]->isNoisy(), i == 0) << i;
  const SensorInfo& sonar = real.sensor_infos->at(0);
  EXPECT_DOUBLE_EQ(sonar.beam_width_rad, 84 * kRadPerDeg) << "42° to each side";
  EXPECT_DOUBLE_EQ(plain.sensor_infos->at(0).beam_width_rad, 26 * kRadPerDeg) << "the main lobe";
  ASSERT_EQ(sonar.beams.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(sonar.beams[i].robot_from_beam, plain.sensor_infos->at(0).beams[i].robot_from_beam) << i;
  }
}

TEST(RobotModel, ScoutHasSixteenEvenlySpacedSonarsAndNoLaser) {
  const RobotModel model = shipped("scout");
  EXPECT_EQ(model.radius_m, 0.19);
  EXPECT_EQ(labelsOf(model), (Lines{"sonar", "heat", "bumper", "odometry", "compass"}));
  const SensorInfo& sonar = model.sensor_infos->at(0);
  ASSERT_EQ(sonar.beams.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) {
    const auto& beam = sonar.beams[i].robot_from_beam;
    EXPECT_NEAR(std::remainder(beam.yaw - 22.5 * kRadPerDeg * static_cast<double>(i), 2 * M_PI), 0, 1e-12);
    EXPECT_NEAR(std::hypot(beam.x, beam.y), 0.19, 1e-12);
  }
}

TEST(RobotModel, SensorsOfTheShippedTypesDetectEachOther) {
  const RobotModel pioneer = shipped("pioneer3dx"), scout = shipped("scout");
  for (const auto* observer : {&pioneer, &scout}) {
    for (const auto& info : *observer->sensor_infos) {
      for (const auto& beam : info.beams) {
        for (const auto* other : {&pioneer, &scout}) {
          EXPECT_TRUE(other->body.heights().contains(beam.robot_from_beam.z))
              << observer->type->model << " " << info.label;
        }
      }
    }
  }
}

TEST(RobotModel, SupportsABoxAboveTheGround) {
  const RobotModel model =
      parsed("<body length_m='0.8' width_m='0.6' height_m='0.5' clearance_m='0.1' color='1 0 0'/>" + kLimits);
  EXPECT_EQ(std::get<Cube>(model.body.shape), (Cube{0.8, 0.6}));
  EXPECT_DOUBLE_EQ(model.radius_m, 0.5);
  EXPECT_DOUBLE_EQ(model.body.heights().z_min_m, 0.1);
  EXPECT_DOUBLE_EQ(model.body.heights().z_max_m, 0.6);
  EXPECT_EQ(model.body.color, (std::array<float, 3>{1, 0, 0}));
  EXPECT_TRUE(model.sensors.empty());
}

TEST(RobotModel, MakesSensorLabelsUnique) {
  const std::string sensors =
      "<sensors><compass/><compass label='compass_2'/><compass/><compass label='north'/><compass/></sensors>";
  EXPECT_EQ(labelsOf(parsed(kBody + kLimits + sensors)),
            (Lines{"compass", "compass_2", "compass_3", "north", "compass_4"}));
}

TEST(RobotModel, KeepsLabelsGivenInTheFile) {
  EXPECT_EQ(labelsOf(parsed(kBody + kLimits + "<sensors><compass/><compass label='compass'/></sensors>")),
            (Lines{"compass_2", "compass"}));
}

TEST(RobotModel, RejectsDuplicateSensorLabels) {
  EXPECT_EQ(faultsOf("<robot name='r'>" + kBody + kLimits +
                     "<sensors>\n<compass label='north'/>\n<heat range_max_m='2' label='north'/>\n</sensors></robot>"),
            Lines{"r.xml:3: <heat label=\"north\">: is taken already, by the sensor in line 2; give each sensor of a "
                  "robot a label of its own"});
}

TEST(RobotModel, RejectsDuplicateIdsOf2005Sensors) {
  ErrorList errors;
  Body body;
  body.shape = Cylinder{0.3};
  const auto sensors = elements(
      "<sensor><id>1</id><type>heat</type><range>15</range></sensor>\n"
      "<sensor><id>2</id><type>sonar</type><range>15</range></sensor>\n"
      "<sensor><id>1.0</id><type>sonar</type><range>15</range></sensor>");
  modelOf2005({.body = &body, .sensors = &sensors, .file = "world.xml", .unit_m = 0.1}, errors);
  EXPECT_EQ(errors.errors(), Lines{"world.xml:3: <id>1.0</id>: is taken already, by the sensor in line 1; give each "
                                   "sensor of a robot an id of its own"});
}

TEST(RobotModel, RejectsALabelThatARecordingCannotHold) {
  EXPECT_EQ(faultsOf("<robot name='r'>" + kBody + kLimits +
                     "<sensors><compass label='GROUND_TRUTH'/>\n<heat range_max_m='2' label='a/b'/></sensors></robot>"),
            (Lines{"r.xml:1: <compass label=\"GROUND_TRUTH\">: is reserved for recordings (GROUND_TRUTH, STATUS, "
                   "INBOX, POINTS); choose another label",
                   "r.xml:2: <heat label=\"a/b\">: must not contain '/', which separates robot and sensor in a "
                   "recording; choose another label"}));
}

TEST(RobotModel, UsesTheWorldFilesSensorsInsteadOfItsOwnAndAddsOdometry) {
  const auto own = elements("<heat range_max_m='2'/><compass/>");
  const RobotModel model =
      parsed(kBody + kLimits + "<sensors><bumper/></sensors>", {.sensors = &own, .file = "world.xml"});
  EXPECT_EQ(labelsOf(model), (Lines{"heat", "compass", "odometry"}));
  const auto with_odometry = elements("<odometry><noise/></odometry>");
  EXPECT_EQ(labelsOf(parsed(kBody + kLimits, {.sensors = &with_odometry, .file = "world.xml"})), Lines{"odometry"});
}

TEST(RobotModel, DigestOfItsSensorsDependsOnEveryOption) {
  const auto digest_of = [](const std::string& sensors) {
    return parsed(kBody + kLimits + "<sensors>" + sensors + "</sensors>").sensors_digest;
  };
  const std::uint64_t battery = digest_of("<battery standing_h='9'/>");
  EXPECT_EQ(digest_of("<battery standing_h='9'/>"), battery);
  EXPECT_EQ(digest_of("<!-- full --><battery  standing_h='9' />"), battery) << "only the content matters";
  EXPECT_NE(digest_of("<battery standing_h='8'/>"), battery);
  EXPECT_NE(digest_of("<battery/>"), battery);
  EXPECT_NE(digest_of("<battery standing_h='9'/><odometry/>"), battery);
  EXPECT_NE(digest_of("<odometry/>"), digest_of("<odometry><noise/></odometry>"));

  const auto own = elements("<battery standing_h='9'/>");
  const std::string type = kBody + kLimits + "<sensors><odometry/></sensors>";
  EXPECT_EQ(parsed(type, {.sensors = &own, .file = "world.xml"}).sensors_digest, battery) << "instead of the type's";
}

TEST(RobotModel, UsesTheWorldFilesBodyAndAdaptsItsBumper) {
  Body body;
  body.shape = Cylinder{0.5};
  body.height_m = 1;
  body.center_z_m = 0.5;
  const RobotModel model =
      parsed(kBody + kLimits + "<sensors><bumper/></sensors>", {.body = &body, .file = "world.xml"});
  EXPECT_EQ(model.radius_m, 0.5);
  EXPECT_EQ(model.sensor_infos->at(0).beams.at(0).robot_from_beam.x, 0.5);
}

TEST(RobotModel, Model2005MovesLikeAPioneerOfItsSize) {
  Body body;
  body.shape = Cylinder{0.3};
  body.height_m = 1;
  body.center_z_m = 0.5;
  const auto sensors = elements(
      "<sensor><id>1</id><type>heat</type><range>15</range></sensor>"
      "<sensor><id>2</id><type>laser</type><position><x-relative>3</x-relative><range>20</range></position></sensor>");
  ErrorList errors;
  const RobotModel model =
      modelOf2005({.body = &body, .sensors = &sensors, .file = "world.xml", .unit_m = 0.1}, errors);
  EXPECT_EQ(errors.errors(), Lines{});
  EXPECT_EQ(model.type->model, "2005");
  EXPECT_EQ(model.type->limits, (MotionLimits{.speed_max_mps = 0.75,
                                              .turn_max_radps = 1.74,
                                              .accel_mps2 = 0.75,
                                              .decel_mps2 = 0.75,
                                              .turn_accel_radps2 = 3.5}));
  EXPECT_EQ(labelsOf(model), (Lines{"heat", "laser", "odometry"}));
  const SensorInfo& laser = model.sensor_infos->at(1);
  ASSERT_EQ(laser.beams.size(), 1u);
  EXPECT_DOUBLE_EQ(laser.beams[0].robot_from_beam.x, 0.3);
  EXPECT_DOUBLE_EQ(laser.range_max_m, 2);
  EXPECT_DOUBLE_EQ(laser.no_echo_m, 2.1);
}

TEST(RobotModel, BrakesInAnEmergencyAsAlwaysUnlessItsTypeBrakesHarder) {
  EXPECT_EQ(parsed(kBody + kLimits).type->limits.emergency_decel_mps2, 3);
  const auto limits_with = [](const std::string& emergency) {
    return kLimits.substr(0, kLimits.size() - 2) + " emergency_decel_mps2='" + emergency + "'/>";
  };
  EXPECT_EQ(parsed(kBody + limits_with("4")).type->limits.emergency_decel_mps2, 4);
  EXPECT_EQ(faultsOf("<robot name='r'>" + kBody + limits_with("2.5") + "</robot>"),
            Lines{"r.xml:1: <limits emergency_decel_mps2=\"2.5\">: must lie in [3, 1000] metres per second squared; "
                  "drop it for the default, 3"});
}

TEST(RobotModel, ReportsAllFaultsAtOnce) {
  EXPECT_EQ(faultsOf("<world/>"), Lines{"r.xml:1: <world>: is not a robot type; the first element of one is <robot>"});
  EXPECT_EQ(faultsOf("<robot name='r'/>"),
            (Lines{"r.xml:1: <robot>: <body> is missing; add it", "r.xml:1: <robot>: <limits> is missing; add it"}));
  EXPECT_EQ(
      faultsOf("<robot name='s'>\n<body radius_m='0' height_m='x'/>\n<limits speed_max_mps='-1' "
               "accel_mps2='1' decel_mps2='1' turn_max_degps='1'/>\n<sensors>\n<sonar/></sensors></robot>"),
      (Lines{"r.xml:1: <robot name=\"s\">: must be the file's name without .xml; rename one of them",
             "r.xml:2: <body radius_m=\"0\">: must lie in (0, 100] metres; write a number there",
             "r.xml:2: <body height_m=\"x\">: is not a number; write a number there",
             "r.xml:3: <limits speed_max_mps=\"-1\">: must lie in (0, 100] metres per second; write a number there",
             "r.xml:3: <limits>: <turn_accel_degps2> is missing; add it",
             "r.xml:5: <sonar>: has no mounting pose; add <at x_m=\"…\" y_m=\"…\" z_m=\"…\" angle_deg=\"…\"/>"}));
  EXPECT_EQ(faultsOf("<robot name='r' hue='1'>" + kBody + kLimits + "</robot>"),
            Lines{"r.xml:1: <robot>: unknown attribute hue=\"1\"; accepted here are: arcos, body, drive, help, limits, "
                  "name, sensors"});
}

TEST(RobotModel, RejectsABodyThatIsBothRoundAndRectangular) {
  EXPECT_EQ(faultsOf("<robot name='r'><body radius_m='1' length_m='1' height_m='1'/>" + kLimits + "</robot>"),
            Lines{"r.xml:1: <body>: unknown attribute length_m=\"1\"; accepted here are: clearance_m, color, fiducial, "
                  "height_m, light, look, "
                  "radius_m"});
}

TEST(RobotModel, RejectsTheSensorThatExceedsTheRayLimit) {
  EXPECT_EQ(faultsOf("<robot name='r'>" + kBody + kLimits +
                     "<sensors>\n<sonar model='rays' rays='1000'><ring count='99' radius_m='0.1'/></sonar>"
                     "\n<laser beams='1000'/>\n<laser beams='1'/></sensors></robot>"),
            (Lines{"r.xml:4: <laser>: has 1 rays, and the sensors before it 100000; a robot may have 100000 in all, so "
                   "use fewer"}));
  EXPECT_EQ(faultsOf("<robot name='r'>" + kBody + kLimits +
                     "<sensors>\n<sonar model='rays' rays='1000'><ring count='1024' radius_m='0.1'/></sonar>"
                     "</sensors></robot>"),
            (Lines{"r.xml:2: <sonar>: has 1024000 rays, and the sensors before it 0; a robot may have 100000 in all, "
                   "so use fewer"}));
}

TEST(RobotModel, NumbersManySensorsOfOneLabelInTheirOrder) {
  // 20,000 sensors: numbering that begins at 2 each time would take 200 million attempts.
  std::string sensors = "<compass label='heat_2'/>";
  for (int i = 0; i < 20000; ++i) sensors += "<heat range_max_m='1'/>";
  const Lines labels = labelsOf(parsed(kBody + kLimits + "<sensors>" + sensors + "</sensors>"));
  ASSERT_EQ(labels.size(), 20001u);
  EXPECT_EQ(labels[0], "heat_2");
  EXPECT_EQ(labels[1], "heat");
  EXPECT_EQ(labels[2], "heat_3");
  EXPECT_EQ(labels[20000], "heat_20001");
}

}  // namespace
}  // namespace robosim
