#include "sensors/added_noise.h"

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/xml_parser.h"
#include "sensors/registry.h"

namespace robosim {
namespace {

std::vector<XmlElement> with(AddedNoise noise, const std::string& sensors) {
  std::vector<XmlElement> children = parseXml("<sensors>" + sensors + "</sensors>", "sensors.xml").children;
  addNoise(noise, children);
  return children;
}

TEST(AddedNoise, IsValidForAllKindsOfSensors) {
  const std::string all =
      "<sonar><ring count='8' radius_m='0.2'/></sonar><laser/><infrared><ring count='8' radius_m='0.2'/></infrared>"
      "<heat/><bumper/><odometry/><compass/><battery/><camera/><range_and_bearing/><gnss/><imu/><encoders/>"
      "<beacons><beacon x_m='1'/></beacons>";
  for (const AddedNoise noise : {AddedNoise::typical, AddedNoise::all}) {
    for (const auto& element : with(noise, all)) {
      ErrorList errors;
      XmlReader reader(element, "sensors.xml", errors);
      const auto sensor = readSensor(reader, {.robot_radius_m = 0.2, .robot_height_m = 0.3});
      ASSERT_TRUE(sensor && errors.empty()) << element.name;
      EXPECT_TRUE(sensor->isNoisy() || element.name == "bumper" || element.name == "camera" ||
                  element.name == "battery" || element.name == "encoders")
          << element.name;
    }
  }
}

TEST(AddedNoise, OfAllErrorsNamesTheSetAndWidensTheBeamOfASonar) {
  const auto sensors = with(AddedNoise::all, "<sonar beam_width_deg='20'><ring count='8' radius_m='0.2'/></sonar>");
  const auto& attributes = sensors.front().attributes;
  const auto has = [&](const std::string& name, const std::string& value) {
    return std::find(attributes.begin(), attributes.end(), std::pair(name, value)) != attributes.end();
  };
  EXPECT_TRUE(has("noise", "polaroid") && has("beam_width_deg", "84") && !has("beam_width_deg", "20"));
}

TEST(AddedNoise, IsValidForTheOdometryOfEveryDrive) {
  for (const DriveKind kind : {DriveKind::omni, DriveKind::car, DriveKind::tracked}) {
    for (const auto& element : with(AddedNoise::all, "<odometry/>")) {
      ErrorList errors;
      XmlReader reader(element, "sensors.xml", errors);
      readSensor(reader, {.robot_radius_m = 0.2, .drive = {.kind = kind, .wheelbase_m = 0.5}});
      EXPECT_TRUE(errors.empty()) << static_cast<int>(kind);
    }
  }
}

TEST(AddedNoise, LeavesSensorsWithNoiseUnchanged) {
  const std::string noisy =
      "<compass><noise std_deg='7'/></compass><laser noise='urg04lx'/><odometry><noise/></odometry>";
  EXPECT_EQ(with(AddedNoise::all, noisy), with(AddedNoise::none, noisy));
}

TEST(AddedNoise, OfAllErrorsAddsNoisyOdometryWhereItWouldBeExact) {
  EXPECT_EQ(with(AddedNoise::all, "<heat/>").back().name, "odometry");
  EXPECT_EQ(with(AddedNoise::typical, "<heat/>").size(), 1u);
  EXPECT_TRUE(with(AddedNoise::all, "").empty());
}

}  // namespace
}  // namespace robosim
