#include "robots/robot_type_includes.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/temporary_directory.h"
#include "robots/robot_model.h"

namespace robosim {
namespace {

using Faults = std::vector<std::string>;

class RobotTypeInclude : public testing::Test {
 protected:
  RobotTypeInclude() { std::filesystem::create_directories(folder_.path() / "sensors"); }

  RobotTypeFile typeWith(const std::string& sensors) const {
    write("r.xml",
          "<robot name='r'><body radius_m='0.2' height_m='0.5'/><limits speed_max_mps='1' accel_mps2='1' "
          "decel_mps2='1' turn_max_degps='90' turn_accel_degps2='180'/>\n<sensors>" +
              sensors + "</sensors></robot>");
    return {folder_.path() / "r.xml", std::nullopt};
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.path() / name) << text; }
  std::string pathOf(const std::string& name) const { return (folder_.path() / name).string(); }

  static RobotModel modelFrom(const RobotTypeFile& type) {
    ErrorList errors;
    RobotModel model = modelOf(readRobotType(type), type.file.string(), {}, errors);
    EXPECT_EQ(errors.errors(), Faults{});
    return model;
  }
  static Faults faultsOf(const RobotTypeFile& type) {
    ErrorList errors;
    readRobotModel(type.file, errors);
    return errors.errors();
  }

  const TemporaryDirectory folder_;
};

TEST_F(RobotTypeInclude, StandsForTheSensorOfTheFile) {
  write("sensors/laser.xml", "<laser beams='3' range_max_m='20'><noise std_m='0.02'/></laser>");
  const RobotModel included = modelFrom(typeWith("<odometry/><include file='sensors/laser.xml'/>"));
  ASSERT_EQ(included.sensors.size(), 2u);
  const SensorInfo& laser = included.sensor_infos->at(1);
  EXPECT_EQ(laser.kind, SensorKind::laser);
  EXPECT_EQ(laser.beams.size(), 3u);
  EXPECT_DOUBLE_EQ(laser.range_max_m, 20);
  const RobotModel pasted =
      modelFrom(typeWith("<odometry/><laser beams='3' range_max_m='20'><noise std_m='0.02'/></laser>"));
  EXPECT_EQ(included.sensors_digest, pasted.sensors_digest) << "the digest is that of the content";
}

TEST_F(RobotTypeInclude, ReplacesSettingsByItsOwnAttributes) {
  write("sensors/laser.xml", "<laser beams='3' x_m='1'><z_m>0.1</z_m></laser>");
  const RobotModel model =
      modelFrom(typeWith("<include file='sensors/laser.xml' x_m='0.1' z_m='0.3' label='front'/>"
                         "<include file='sensors/laser.xml' label='rear' angle_deg='180'/>"));
  ASSERT_EQ(model.sensor_infos->size(), 2u);
  const SensorInfo& front = model.sensor_infos->at(0);
  EXPECT_EQ(front.label, "front");
  EXPECT_DOUBLE_EQ(front.beams.at(0).robot_from_beam.x, 0.1);
  EXPECT_DOUBLE_EQ(front.beams.at(0).robot_from_beam.z, 0.3);
  EXPECT_EQ(model.sensor_infos->at(1).label, "rear");
  EXPECT_DOUBLE_EQ(model.sensor_infos->at(1).beams.at(0).robot_from_beam.z, 0.1);
}

TEST_F(RobotTypeInclude, BecomesPartOfTheText) {
  write("sensors/laser.xml", "<laser beams='3'/>");
  const RobotTypeFile type = typeWith("<include file='sensors/laser.xml' z_m='0.3'/>");
  const RobotTypeFile received{"elsewhere/r.xml", resolveIncludes(type)};
  EXPECT_EQ(received.text->find("include"), std::string::npos);
  EXPECT_EQ(modelFrom(received).sensors_digest, modelFrom(type).sensors_digest);
  EXPECT_EQ(filesIncludedBy(type), (std::vector<std::filesystem::path>{folder_.path() / "sensors/laser.xml"}));
  const RobotTypeFile without = typeWith("<odometry/>");
  std::ostringstream verbatim;
  verbatim << std::ifstream(without.file).rdbuf();
  EXPECT_EQ(resolveIncludes(without), verbatim.str());
}

TEST_F(RobotTypeInclude, ReportsTheLineOfTheIncludedFile) {
  write("sensors/laser.xml", "<laser\n beams='3'>\n<noise std_m='2'/></laser>");
  const RobotTypeFile type = typeWith("<include file='sensors/laser.xml'/>");
  const std::string fault = pathOf("sensors/laser.xml") + ":3: <noise std_m=\"2\">: must lie in [0, 1]";
  ASSERT_EQ(faultsOf(type).size(), 1u);
  EXPECT_TRUE(faultsOf(type)[0].starts_with(fault)) << faultsOf(type)[0];
  try {
    resolveIncludes(type);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_TRUE(error.errors().at(0).starts_with(fault)) << error.what();
  }
}

TEST_F(RobotTypeInclude, IsRefusedOutsideTheFolderAndForOtherContents) {
  write("sensors/nested.xml", "<include file='laser.xml'/>");
  write("sensors/type.xml", "<robot/>");
  write("sensors/other.xml", "<lamp/>");
  const auto faultOf = [&](const std::string& include) {
    const Faults faults = faultsOf(typeWith("\n" + include));
    return faults.size() == 1 ? faults[0] : std::to_string(faults.size()) + " faults";
  };
  const std::string type = pathOf("r.xml") + ":3: <include";
  EXPECT_EQ(faultOf("<include file='/etc/a.xml'/>"),
            type +
                " file=\"/etc/a.xml\">: is an absolute path; only files in the robot type's folder, or below it, are "
                "included");
  EXPECT_EQ(faultOf("<include file='../a.xml'/>"),
            type +
                " file=\"../a.xml\">: contains '..'; only files in the robot type's folder, or below it, are "
                "included");
  EXPECT_EQ(faultOf("<include file='a.png'/>"), type + " file=\"a.png\">: must end in .xml");
  EXPECT_TRUE(faultOf("<include file='none.xml'/>").starts_with(type + " file=\"none.xml\">: "));
  const std::string not_a_sensor = ": is not a sensor; the first element of an included file is one, such as <laser>";
  EXPECT_EQ(faultOf("<include file='sensors/nested.xml'/>"),
            pathOf("sensors/nested.xml") + ":1: <include>" + not_a_sensor);
  EXPECT_EQ(faultOf("<include file='sensors/type.xml'/>"), pathOf("sensors/type.xml") + ":1: <robot>" + not_a_sensor);
  EXPECT_TRUE(
      faultOf("<include file='sensors/other.xml'/>").starts_with(pathOf("sensors/other.xml") + ":1: <lamp>: is not a"));
  EXPECT_EQ(faultOf("<include file='a.xml'><laser/></include>"),
            type + ">: has a content; an <include> has attributes only");
}

TEST_F(RobotTypeInclude, IsRefusedInAReceivedText) {
  RobotTypeFile type = typeWith("<include file='sensors/laser.xml'/>");
  std::ostringstream text;
  text << std::ifstream(type.file).rdbuf();
  type.text = text.str();
  EXPECT_THROW(readRobotType(type), ConfigError);
}

}  // namespace
}  // namespace robosim
