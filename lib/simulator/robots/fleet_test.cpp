#include "robots/fleet.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/data_folders.h"
#include "base/testing/test_folder.h"
#include "robots/robot_type_folders_text.h"
#include "world/world_file.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

const std::filesystem::path kWorlds = ROBOSIM_SOURCE_DIR "/worlds";
const std::vector<std::filesystem::path> kTypes{kWorlds / "robots"};

/// Knows two controllers, without parameters.
void checkController(const std::string& controller) {
  if (controller != "wander" && controller != "gold_finder")
    throw ConfigError("there is no controller '" + controller + "'");
}

/// A world of these robots, each on its own line, the first on line 2.
std::string worldOf(const Lines& robots, const std::string& unit_m = "1") {
  std::string text = "<world unit_m='" + unit_m +
                     "'><surface><size><xmin>-50</xmin><xmax>50</xmax><ymin>-50</ymin><ymax>50</ymax></size>";
  for (const auto& robot : robots) text += "\n<object><shape><robot>" + robot + "</robot></shape></object>";
  return text + "</surface></world>";
}

std::string placed(const std::string& model, const std::string& name, double x, const std::string& more = "") {
  return "<model>" + model + "</model><name>" + name + "</name><x>" + toText(x) + "</x><y>0</y>" + more;
}

std::string of2005(const std::string& name, double x, const std::string& sensors = "") {
  return "<cylinder><name>" + name + "</name><x>" + toText(x) +
         "</x><y>0</y><z>5</z><radius>3</radius><height>10</height></cylinder>" + sensors;
}

Fleet fleetOf(const std::string& text, ErrorList& errors) {
  const World world = parseWorld(text, "w.xml", errors);
  return buildFleet(world, "w.xml", robotTypesIn(kTypes), checkController, errors);
}

Fleet fleetOf(const std::string& text) {
  ErrorList errors;
  Fleet fleet = fleetOf(text, errors);
  EXPECT_EQ(errors.errors(), Lines{});
  return fleet;
}

Lines faults(const std::string& text) {
  ErrorList errors;
  fleetOf(text, errors);
  return errors.errors();
}

class WorldFolder : public TestFolder {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_ / "robots"); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
};

TEST(Fleet, KeepsTheWorldsOrderOfRobots) {
  const Fleet fleet = fleetOf(worldOf({placed("scout", "B", 3,
                                              "<direction>7</direction><color>1 0 0</color>"
                                              "<controller>wander</controller>"),
                                       placed("pioneer3dx", "A", 6, "<neighbour>B</neighbour>")}));
  ASSERT_EQ(fleet.robots.size(), 2u);
  const FleetRobot& b = fleet.robots[0];
  EXPECT_EQ(b.info.name, "B");
  EXPECT_EQ(b.info.type->model, "scout");
  EXPECT_EQ(b.info.radius_m, 0.19);
  EXPECT_EQ(b.info.type, b.model->type);
  EXPECT_EQ(b.info.sensors, b.model->sensor_infos);
  EXPECT_NEAR(b.world_from_start.phi, 7 - 2 * M_PI, 1e-12);
  EXPECT_EQ(b.body().world_from_body, b.world_from_start);
  EXPECT_EQ(b.body().color, (std::array<float, 3>{1, 0, 0}));
  EXPECT_EQ(*b.controller, "wander");
  EXPECT_EQ(fleet.robots[1].info.neighbour, "B");
  EXPECT_EQ(*fleet.robots[1].controller, "");
}

TEST(Fleet, EqualRobotsShareOneModel) {
  const std::string heat = "<sensor><type>heat</type><range>15</range></sensor>";
  const std::string sensors = "<sensors><compass/></sensors>";
  const Fleet fleet = fleetOf(worldOf({placed("scout", "A", 0), placed("scout", "B", 2), placed("pioneer3dx", "C", 4),
                                       placed("scout", "D", 6, sensors), placed("scout", "E", 8, sensors),
                                       of2005("F", 20, heat), of2005("G", 27, heat), of2005("H", 34)}));
  const auto& robots = fleet.robots;
  EXPECT_EQ(robots[0].model, robots[1].model);
  EXPECT_NE(robots[0].model, robots[2].model);
  EXPECT_NE(robots[0].model, robots[3].model);
  EXPECT_EQ(robots[3].model, robots[4].model);
  EXPECT_EQ(robots[5].model, robots[6].model);
  EXPECT_NE(robots[5].model, robots[7].model);
}

TEST(Fleet, RobotsOfBodiesOfDifferentHeightShareNoModel) {
  std::string taller = of2005("C", 20);
  taller.replace(taller.find("<height>10"), 10, "<height>11");
  const Fleet fleet = fleetOf(worldOf({of2005("A", 0), of2005("B", 10), taller}));
  EXPECT_EQ(fleet.robots[0].model, fleet.robots[1].model);
  EXPECT_NE(fleet.robots[0].model, fleet.robots[2].model);
  EXPECT_EQ(fleet.robots[2].info.height_m, 11);
}

TEST(Fleet, Reads2005RobotsInTheFilesUnit) {
  const Fleet fleet = fleetOf(worldOf({of2005("A", 10, "<sensor><type>heat</type><range>15</range></sensor>")}, "0.1"));
  const FleetRobot& robot = fleet.robots[0];
  EXPECT_EQ(robot.info.type->model, "2005");
  EXPECT_DOUBLE_EQ(robot.info.radius_m, 0.3);
  EXPECT_DOUBLE_EQ(robot.info.height_m, 1);
  EXPECT_DOUBLE_EQ(robot.world_from_start.x, 1);
  ASSERT_EQ(robot.info.sensors->size(), 2u);
  EXPECT_DOUBLE_EQ(robot.info.sensors->at(0).range_max_m, 1.5);
  EXPECT_EQ(robot.info.sensors->at(1).label, "odometry");
}

TEST(Fleet, RejectsUnknownModelsAndControllersThatTheCheckRejects) {
  const std::string known =
      "known are: amigo-sh, carrier, epuck, f1tenth, footbot, husky_a200, khepera, mpo500, p3at, p3at-sh, p3dx, "
      "p3dx-sh, "
      "p3dx_gripper, p3dx_gyro, p3dx_ptz, pioneer3dx, pioneer3dx_camera, pioneer3dx_driven, pioneer3dx_polaroid, "
      "pusher "
      "and "
      "6 more; " +
      robotTypeFoldersText();
  EXPECT_EQ(faults(worldOf({placed("pionier", "A", 0), placed("scout", "B", 2, "<controller>wonder</controller>"),
                            placed("../robots/scout", "C", 4)})),
            (Lines{"w.xml:2: robot 'A': there is no robot type 'pionier'; " + known,
                   "w.xml:3: robot 'B': there is no controller 'wonder'",
                   "w.xml:4: robot 'C': there is no robot type '../robots/scout'; " + known}));
}

TEST(Fleet, ReportsARejectedControllerAtItsElementOnceForEachRobot) {
  const std::string controller = "\n<controller name='wander' speed='2'/>";
  const std::string fault = "there is no controller 'wander speed=2'";
  EXPECT_EQ(faults(worldOf({placed("scout", "A", 0, controller), placed("scout", "B", 2, controller)})),
            (Lines{"w.xml:3: robot 'A': " + fault, "w.xml:5: robot 'B': " + fault}));
}

TEST(Fleet, ReportsFaultySensorsOfEveryRobot) {
  const std::string sensor = "<sensor><type>radar</type></sensor>";
  EXPECT_EQ(faults(worldOf({of2005("A", 0, sensor), of2005("B", 10, sensor),
                            placed("scout", "C", 20, "<sensors><heat range_max_m='-1'/></sensors>")})),
            (Lines{"w.xml:2: <type>radar</type>: is unknown; accepted are: sonar, laser, heat",
                   "w.xml:3: <type>radar</type>: is unknown; accepted are: sonar, laser, heat",
                   "w.xml:4: <heat range_max_m=\"-1\">: must lie in (0, 1e+06] metres; drop it for the default, 1.5"}));
}

TEST(Fleet, RejectsRobotsThatOverlapOrStandOutside) {
  EXPECT_EQ(faults(worldOf({placed("scout", "A", 0), placed("scout", "B", 0.3), placed("scout", "C", 50)})),
            (Lines{"w.xml:3: robot 'B' at (0.3, 0) m overlaps the robot 'A' of line 2; move one of them",
                   "w.xml:4: robot 'C' at (50, 0) m stands outside the surface, or reaches over its edge; move it "
                   "inside, or widen the "
                   "surface's <size>"}));
}

TEST(Fleet, DoesNotCheckOverlapsAfterEarlierErrors) {
  EXPECT_EQ(faults(worldOf({placed("scout", "A", 1), "<model>scout</model><name>B</name><x>one</x><y>0</y>"})),
            Lines{"w.xml:3: <x>one</x>: is not a number; write a number there"});
}

TEST_F(WorldFolder, TypesBesideTheWorldPrecedeTheShippedOnes) {
  write("robots/scout.xml",
        "<robot name='scout'><body radius_m='0.5' height_m='0.5'/><limits speed_max_mps='1' accel_mps2='2' "
        "decel_mps2='3' turn_max_degps='90' turn_accel_degps2='180'/></robot>");
  const auto file = write("w.xml", worldOf({placed("scout", "A", 0), placed("pioneer3dx", "B", 5)}));
  const LoadedWorld loaded = loadWorld(file, {});
  EXPECT_EQ(loaded.fleet.robots[0].info.radius_m, 0.5);
  EXPECT_EQ(loaded.fleet.robots[1].info.radius_m, 0.267);
}

TEST_F(WorldFolder, ReportsAFaultyTypeOnce) {
  const auto type =
      write("robots/broken.xml",
            "<robot name='broken'><body radius_m='0' height_m='1'/><limits speed_max_mps='1' accel_mps2='2' "
            "decel_mps2='3' turn_max_degps='90' turn_accel_degps2='180'/></robot>");
  const auto file = write("w.xml", worldOf({placed("broken", "A", 0), placed("broken", "B", 5)}));
  try {
    loadWorld(file, {});
    FAIL() << "nothing was thrown";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.what(),
              type.string() + ":1: <body radius_m=\"0\">: must lie in (0, 100] metres; write a number there");
  }
}

TEST_F(WorldFolder, IsSearchedForRobotTypesBeforeOtherFolders) {
  ASSERT_EQ(setenv("ROBOSIM_PATH", "/elsewhere", 1), 0);
  const auto folders = robotTypeFolders("here/w.xml");
  unsetenv("ROBOSIM_PATH");
  const auto shipped = shareFolder() / "worlds" / "robots";
  EXPECT_EQ(folders, (std::vector<std::filesystem::path>{"here/robots", "/elsewhere/robots", shipped}));
  EXPECT_EQ(robotTypeFolders("w.xml"), (std::vector<std::filesystem::path>{"robots", shipped}));
  EXPECT_TRUE(std::filesystem::equivalent(shipped, kWorlds / "robots"));
}

TEST_F(WorldFolder, AHundredThousandRobotsLoadWithOneModel) {
  std::string text = "<world><surface><size><xmin>-1</xmin><xmax>400</xmax><ymin>-1</ymin><ymax>400</ymax></size>";
  for (int i = 0; i < 100'000; ++i) {
    text += "<object><shape><robot><model>scout</model><name>" + std::to_string(i) + "</name><x>" +
            std::to_string(i % 317) + "</x><y>" + std::to_string(i / 317) + "</y></robot></shape></object>\n";
  }
  const LoadedWorld loaded = loadWorld(write("w.xml", text + "</surface></world>"), nullptr);
  ASSERT_EQ(loaded.fleet.robots.size(), 100'000u);
  EXPECT_EQ(loaded.fleet.robots.front().model, loaded.fleet.robots.back().model);
}

TEST(Fleet, RejectsTheRobotThatExceedsTheBeamLimit) {
  // Equal robots share their sensors; each has its own readings: 501 × 100,000 beams are more than 50 million.
  const std::string laser = "<laser beams='10000'/>";
  std::string sensors;
  for (int i = 0; i < 10; ++i) sensors += laser;
  Lines robots;
  for (int i = 0; i < 501; ++i) {
    robots.push_back(
        placed("scout", "r" + std::to_string(i), -45 + 0.4 * (i % 200), "<sensors>" + sensors + "</sensors>"));
    robots.back().replace(robots.back().find("<y>0</y>"), 8, "<y>" + toText(i / 200) + "</y>");
  }
  EXPECT_EQ(faults(worldOf(robots)),
            (Lines{"w.xml:502: robot 'r500': with it the robots have more than 50000000 beams; use fewer robots, or "
                   "sensors of fewer beams"}));
  robots.pop_back();
  EXPECT_EQ(faults(worldOf(robots)), Lines{});
}

TEST(Fleet, RejectsTheRobotThatExceedsTheLimitOfPictures) {
  // 2^20 pixels: 20 MiB once, and 11 MiB for each robot, of which 171 are less than 2 GB.
  const std::string camera =
      "<sensors><camera model='raycast' layers='rgb depth identity' width_px='1024' height_px='1024'/></sensors>";
  Lines robots;
  for (int i = 0; i < 172; ++i) robots.push_back(placed("scout", "r" + std::to_string(i), -45 + 0.4 * i, camera));
  EXPECT_EQ(faults(worldOf(robots)),
            (Lines{"w.xml:173: robot 'r171': with it the ray-cast pictures of the robots take more than 2000000000 "
                   "bytes; use fewer robots, or cameras of fewer pixels or layers"}));
  robots.pop_back();
  EXPECT_EQ(faults(worldOf(robots)), Lines{});
}

TEST(Fleet, RejectsTheRobotThatExceedsTheLimitOfRaysOfAllModels) {
  // 21 models of 100 sonars of 1,000 rays each: 21 × 100,000 are more than 2 million.
  Lines robots;
  for (int i = 0; i < 21; ++i) {
    robots.push_back(placed("scout", "r" + std::to_string(i), i,
                            "<sensors><sonar model='rays' rays='1000' range_max_m='" + toText(i + 1) +
                                "'><ring count='100' radius_m='0.1'/></sonar></sensors>"));
  }
  EXPECT_EQ(faults(worldOf(robots)),
            (Lines{"w.xml:22: robot 'r20': with it the sensors of the 21 kinds of robots have more than 2000000 rays; "
                   "use fewer robots, or sensors of fewer beams"}));
}

}  // namespace
}  // namespace robosim
