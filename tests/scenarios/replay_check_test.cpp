// `robosim replay --check` and `--controller`: recorded runs are repeated; damaged recordings and other worlds.

#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client/network_hardware.h"
#include "tests/scenarios/recorded_run.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/serving.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

using nlohmann::json;

TEST(ReplayCheck, RepeatsTheRunIdentically) {
  const auto file = emptyFolder() / "run.rawlog";
  const json run = recordRun("worlds/opho2_1.xml --seed 4 --time 60", file);
  const Ended check = runProgram("replay --check worlds/opho2_1.xml " + quoted(file));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_EQ(check.out, "The same run: 600 steps, digest " + run["digest"].get<std::string>() + "\n");
}

TEST(ReplayCheck, RepeatsTheRunOfARobotThatFacesBackwards) {
  // A heading of half a turn is recorded as a matrix, whose angle may be π or -π.
  const auto folder = emptyFolder();
  std::ofstream(folder / "world.xml")
      << "<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size><object><shape><robot>"
         "<model>scout</model><name>R</name><x>0</x><y>0</y><direction>3.141592653589793</direction>"
         "<controller>still</controller></robot></shape></object></surface></world>";
  recordRun(quoted(folder / "world.xml") + " --time 1", folder / "run.rawlog");
  const Ended check =
      runProgram("replay --check " + quoted(folder / "world.xml") + " " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

TEST(ReplayCheck, RepeatsTheRunOfRobotsInOtherProcesses) {
  // gold_finder sends messages; wander is not the controller that the world gives.
  for (const std::string controller : {"gold_finder", "wander"}) {
    const auto rawlog = emptyFolder() / "run.rawlog";
    Serving serving({"--wait-for-robots", "--time", "60", "--record", rawlog.string()});
    const auto robots = startRobots({"Pioneer1", "Scout1"}, serving.address(), controller);
    EXPECT_EQ(serving.program().wait().exit_code, 0);
    const Ended mail = runProgram("replay --print --sensor INBOX " + quoted(rawlog));
    EXPECT_EQ(mail.exit_code == 0, controller == "gold_finder") << mail.out;
    const Ended check = runProgram("replay --check worlds/small_maze.xml " + quoted(rawlog));
    EXPECT_EQ(check.exit_code, 0) << controller << check.out << check.err;
    EXPECT_TRUE(check.out.starts_with("The same run: ")) << check.out;
  }
}

TEST(ReplayCheck, RepeatsARefusedCheckWinAndComparesThePanOfTheLaser) {
  const auto rawlog = emptyFolder() / "run.rawlog";
  Serving serving({"--wait-for-robots", "--time", "0.5", "--record", rawlog.string()});
  {
    NetworkHardware robots({.address = serving.address()}, {"Pioneer1", "Scout1"});
    do {
      robots.robot(0).command({0, 0, 0.5F, Activity::active});
      robots.robot(1).command({});
      if (robots.robot(0).readings().time.step == 2) robots.robot(0).referee()->checkWin();
    } while (robots.nextStep());
  }
  EXPECT_EQ(serving.program().wait().exit_code, 0);
  const Ended status = runProgram("replay --print --robot Pioneer1 --sensor STATUS " + quoted(rawlog));
  EXPECT_EQ(countOf("too far to win", status.out), 1U) << status.out;
  const Ended check = runProgram("replay --check worlds/small_maze.xml " + quoted(rawlog));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  const Ended pioneer = runProgram("replay --controller still --robot Pioneer1 " + quoted(rawlog));
  EXPECT_NE(pioneer.out.find(" commands differ"), std::string::npos) << pioneer.out << pioneer.err;
  const Ended scout = runProgram("replay --controller still --robot Scout1 " + quoted(rawlog));
  EXPECT_NE(scout.out.find(" commands are the recorded ones"), std::string::npos) << scout.out << scout.err;
}

TEST(ReplayCheck, ReportsTheFirstDifferenceInAChangedWorld) {
  const auto folder = emptyFolder();
  recordRun("worlds/opho2_1.xml --time 100", folder / "run.rawlog");
  std::string text = textOf(ROBOSIM_SOURCE_DIR "/worlds/opho2_1.xml");
  const auto at = text.find("<hot>20");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 7, "<hot>21");
  std::ofstream(folder / "hotter.xml") << text;
  const Ended check =
      runProgram("replay --check " + quoted(folder / "hotter.xml") + " " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(check.exit_code, 2) << check.out << check.err;
  EXPECT_NE(check.out.find("The world has changed"), std::string::npos) << check.out;
  EXPECT_NE(check.out.find("Not the same run. It first differs in step "), std::string::npos) << check.out;
  EXPECT_NE(check.out.find(", heat, value: recorded "), std::string::npos) << check.out;
}

/// A world of 10 m × 10 m with one robot, which has these sensors.
std::filesystem::path worldWithSensors(const std::filesystem::path& folder, const std::string& sensors) {
  std::ofstream(folder / "world.xml")
      << "<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size><object><shape><robot>"
         "<model>pioneer3dx</model><name>R</name><x>0</x><y>0</y><controller>wander</controller>"
      << sensors << "</robot></shape></object></surface></world>";
  return folder / "world.xml";
}

TEST(ReplayCheck, PrintsAndRepeatsRangesToBeacons) {
  const auto folder = emptyFolder();
  const auto world = worldWithSensors(folder,
                                      "<sensors><odometry/><sonar><ring count='8' radius_m='0.2'/></sonar>"
                                      "<beacons><noise/><beacon x_m='3' y_m='4'/><beacon x_m='99'/></beacons>"
                                      "</sensors>");
  recordRun(quoted(world) + " --time 2", folder / "run.rawlog");
  const std::string rawlog = quoted(folder / "run.rawlog");
  const Ended check = runProgram("replay --check " + quoted(world) + " " + rawlog);
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  const std::string csv = runProgram("replay --print --csv --sensor beacons " + rawlog).out;
  EXPECT_EQ(csv.rfind("seconds,label,range_0_m\n0.0000000,R/beacons,", 0), 0U) << csv;
  const std::string text = runProgram("replay --print --sensor beacons " + rawlog).out;
  EXPECT_EQ(countOf("s  R/beacons  0: ", text), 21U) << text;
  EXPECT_EQ(countOf(" m\n", text), 21U) << text;
}

TEST(ReplayCheck, ControllerRepeatsItsCommandsOnRecordedReadings) {
  const auto file = emptyFolder() / "run.rawlog";
  // Sector sonars, whose echoes are off their axes, and messages: both are restored exactly.
  recordRun("worlds/opho2_1.xml", file);
  const Ended same = runProgram("replay --controller recorded " + quoted(file));
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_EQ(countOf("commands are the recorded ones", same.out), 4U) << same.out;
  const Ended other = runProgram("replay --controller wander --robot Finder1 " + quoted(file));
  EXPECT_EQ(countOf("commands differ", other.out), 1U) << other.out;
  EXPECT_NE(other.out.find("first in step 1 (0.100 s): recorded "), std::string::npos) << other.out;
}

TEST(ReplayCheck, ChecksTheReadablePartOfATruncatedRecording) {
  const auto file = emptyFolder() / "run.rawlog";
  recordRun("worlds/opho2_1.xml --time 40", file);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const Ended check = runProgram("replay --check worlds/opho2_1.xml " + quoted(file));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_NE(check.out.find("it is cut off"), std::string::npos) << check.out;
  EXPECT_NE(check.out.find(" steps, is the same."), std::string::npos) << check.out;
  const Ended summary = runProgram("replay " + quoted(file));
  EXPECT_EQ(summary.exit_code, 0);
  EXPECT_NE(summary.out.find("ends early, after "), std::string::npos) << summary.out;
}

TEST(ReplayCheck, UsesTheReadableEntriesOfARecordingWithADamagedPictureAndFails) {
  const auto folder = emptyFolder();
  const auto world = folder / "room.xml";
  std::ofstream(world) << R"(<world><surface>
    <size><xmin>0</xmin><xmax>4</xmax><ymin>0</ymin><ymax>4</ymax></size>
    <object><shape><robot><model>pioneer3dx_camera</model><name>Ann</name><x>2</x><y>2</y>
      <controller>wander</controller></robot></shape></object>
  </surface></world>)";
  recordRun(quoted(world) + " --time 0.5", folder / "run.rawlog");
  ASSERT_EQ(
      runCommand("(zcat " + quoted(folder / "run.rawlog") + " > " + quoted(folder / "plain.rawlog") + ")").exit_code,
      0);
  std::string bytes = textOf(folder / "plain.rawlog");
  const auto picture = bytes.find("\xff\xd8\xff");
  ASSERT_NE(picture, std::string::npos);
  bytes[picture] = 'G';
  std::ofstream(folder / "plain.rawlog", std::ios::binary) << bytes;
  const auto count_of = [&](const std::string& out) { return countOf("\n", out); };
  const Ended whole = runProgram("replay --print " + quoted(folder / "run.rawlog"));
  const Ended damaged = runProgram("replay --print " + quoted(folder / "plain.rawlog"));
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_EQ(count_of(damaged.out) + 1, count_of(whole.out));
  EXPECT_NE(damaged.err.find("plain.rawlog: a picture is damaged and left out, in entry "), std::string::npos)
      << damaged.err;
  for (const std::string& command : std::vector<std::string>{
           "replay FILE", "replay --controller recorded FILE", "export FILE OUT.csv", "view FILE --offscreen OUT.png",
           "replay --check " + quoted(world) + " FILE", "replay FILE --output OUT.rawlog"}) {
    std::string line = command;
    line.replace(line.find("FILE"), 4, quoted(folder / "plain.rawlog"));
    if (const auto out = line.find("OUT"); out != std::string::npos) line.replace(out, 3, (folder / "out").string());
    const Ended ended = runProgram(line);
    EXPECT_EQ(ended.exit_code, 1) << line << '\n' << ended.err;
    EXPECT_NE((ended.out + ended.err).find("a picture is damaged and left out"), std::string::npos) << line;
  }
}

TEST(ReplayCheck, ChecksAndReplaysEachFileOfPairsSeparately) {
  const auto folder = emptyFolder();
  const Ended run =
      runProgram("run worlds/opho2_1.xml --json --rawlog-format sf --record " + quoted(folder / "run.rawlog"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json summary = json::parse(run.out);
  const std::string same = "The same run: " + std::to_string(summary["steps"].get<int>()) + " steps, digest " +
                           summary["digest"].get<std::string>() + "\n";
  for (const std::string robot : {"Finder1", "Finder2"}) {
    const std::string file = quoted(folder / ("run_" + robot + ".rawlog"));
    const Ended check = runProgram("replay --check worlds/opho2_1.xml " + file);
    EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
    EXPECT_EQ(check.out, same);
    const Ended replay = runProgram("replay --controller recorded " + file);
    EXPECT_EQ(replay.exit_code, 0) << replay.err;
    EXPECT_EQ(replay.out.rfind(robot + "  all ", 0), 0U) << replay.out;
    EXPECT_EQ(countOf("\n", replay.out), 1U) << replay.out;
  }
}

TEST(ReplayCheck, ChecksARunWithoutItsFolderOfPictures) {
  const auto folder = emptyFolder();
  const auto world = folder / "room.xml";
  std::ofstream(world) << R"(<world><surface>
    <size><xmin>0</xmin><xmax>4</xmax><ymin>0</ymin><ymax>4</ymax></size>
    <object><shape><robot><model>pioneer3dx_camera</model><name>Ann</name><x>2</x><y>2</y>
      <controller>wander</controller></robot></shape></object>
  </surface></world>)";
  recordRun(quoted(world) + " --time 0.5 --record-images external", folder / "run.rawlog");
  ASSERT_GT(std::filesystem::remove_all(folder / "run_Images"), 0U);
  const Ended check = runProgram("replay --check " + quoted(world) + " " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_EQ(check.out.rfind("The same run: 5 steps", 0), 0U) << check.out;
}

TEST(ReplayCheck, RejectsRecordingsWithoutACompleteStep) {
  const auto folder = emptyFolder();
  recordRun("worlds/opho2_1.xml --time 1", folder / "run.rawlog");
  ASSERT_EQ(
      runCommand("(zcat " + quoted(folder / "run.rawlog") + " > " + quoted(folder / "plain.rawlog") + ")").exit_code,
      0);
  const auto second = textOf(folder / "plain.rawlog").find("CObservationOdometry");
  ASSERT_NE(second, std::string::npos);
  std::filesystem::resize_file(folder / "plain.rawlog", second);
  EXPECT_NE(refusalOf("replay --check worlds/opho2_1.xml " + quoted(folder / "plain.rawlog"))
                .find("it is cut off; it has no complete step to compare"),
            std::string::npos);
  EXPECT_NE(refusalOf("replay --controller recorded " + quoted(folder / "plain.rawlog")).find("no command to compare"),
            std::string::npos);
}

TEST(ReplayCheck, RejectsOtherFilesAndOtherWorlds) {
  const auto folder = emptyFolder();
  const Ended world = runProgram("replay worlds/small_maze.xml");
  EXPECT_EQ(world.exit_code, 1);
  EXPECT_NE(world.err.find("is a world: robosim run, serve, check, view, export and bench take it"), std::string::npos)
      << world.err;
  EXPECT_NE(runProgram("replay none.rawlog").err.find("none.rawlog: no such file; check the path"), std::string::npos);
  recordRun("worlds/opho2_1.xml --time 1", folder / "run.rawlog");
  const Ended other = runProgram("replay --check worlds/small_maze.xml " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("has 2 robots, and the recording 4"), std::string::npos) << other.err;
}

TEST(ReplayCheck, RecordsIdenticalRunsIdentically) {
  const auto folder = emptyFolder();
  for (const char* name : {"one.rawlog", "two.rawlog"}) recordRun("worlds/small_maze.xml --time 20", folder / name);
  EXPECT_EQ(textOf(folder / "one.rawlog"), textOf(folder / "two.rawlog"));
}

}  // namespace
}  // namespace robosim
