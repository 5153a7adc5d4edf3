// `robosim replay` on recordings of RoboSim, damaged ones, and those of other programs.

#include <filesystem>
#include <fstream>
#include <functional>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/poses/CPose3DInterpolator.h>
#include <mrpt/system/datetime.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "client/network_hardware.h"
#include "tests/scenarios/foreign_rawlog.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/serving.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

using nlohmann::json;

/// Runs and records a world. @return the summary
json record(const std::string& arguments, const std::filesystem::path& file) {
  const Ended run = runProgram("run " + arguments + " --json --record " + quoted(file));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return json::parse(run.out);
}

/// Odometry as recorded by another program, with these timestamps.
void writeOdometry(const std::filesystem::path& file, int count,
                   const std::function<mrpt::Clock::time_point(int)>& timestamp,
                   const std::string& label = "ODOMETRY") {
  mrpt::io::CFileGZOutputStream stream(file.string());
  auto archive = mrpt::serialization::archiveFrom(stream);
  for (int i = 0; i < count; ++i) {
    mrpt::obs::CObservationOdometry odometry;
    odometry.sensorLabel = label;
    odometry.timestamp = timestamp(i);
    odometry.odometry = {0.1 * i, 0, 0};
    archive << odometry;
  }
}

mrpt::Clock::time_point fiveTimesASecond(int i) { return mrpt::Clock::fromDouble(1.2e9 + 0.2 * i); }

/// Error text of the program.
std::string refusal(const std::string& arguments) {
  const Ended ended = runProgram(arguments);
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  return ended.err;
}

TEST(Replay, SummarisesSensorsAndOutcome) {
  const auto file = emptyFolder() / "run.rawlog";
  const json run = record("worlds/small_maze.xml --seed 3", file);
  const Ended replay = runProgram("replay --json " + quoted(file));
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  const json summary = json::parse(replay.out);
  EXPECT_EQ(summary["whole"], true);
  EXPECT_EQ(summary["run"]["world"], "small_maze.xml");
  EXPECT_EQ(summary["run"]["seed"], 3);
  EXPECT_EQ(summary["run"]["outcome"]["digest"], run["digest"]);
  EXPECT_EQ(summary["run"]["outcome"]["gold_found_by"], run["gold_found_by"]);
  EXPECT_NEAR(summary["duration_s"].get<double>(), run["sim_time_s"].get<double>(), 1e-9);
  double driven_m = 0;
  for (const auto& robot : summary["driven_m"]) driven_m += robot.get<double>();
  EXPECT_NEAR(driven_m, run["driven_m"].get<double>(), 0.01 * driven_m) << "chords are a little shorter than arcs";
  const std::uint64_t steps = run["steps"].get<std::uint64_t>() + 1;
  std::uint64_t sonars = 0;
  for (const auto& channel : summary["channels"]) {
    const std::string label = channel["label"];
    if (!label.ends_with("/sonar")) continue;
    ++sonars;
    EXPECT_EQ(channel["class"], "CObservationRange");
    EXPECT_EQ(channel["count"], steps);
    EXPECT_NEAR(channel["rate_hz"].get<double>(), 10, 1e-6);
  }
  EXPECT_EQ(sonars, 2U);
}

TEST(Replay, SelectsRobotsSensorsAndTimes) {
  const auto file = emptyFolder() / "run.rawlog";
  record("worlds/opho2_1.xml --time 5", file);
  const Ended one = runProgram("replay --print --robot Finder2 --sensor heat --from 1 --to 1.2 " + quoted(file));
  EXPECT_EQ(countOf("\n", one.out), 3U) << one.out;
  EXPECT_EQ(countOf("Finder2/heat", one.out), 3U) << one.out;
  EXPECT_EQ(one.out.rfind("1.000 s  Finder2/heat", 0), 0U) << one.out;
}

TEST(Replay, RepeatsTheRunIdentically) {
  const auto file = emptyFolder() / "run.rawlog";
  const json run = record("worlds/opho2_1.xml --seed 4 --time 60", file);
  const Ended check = runProgram("replay --check worlds/opho2_1.xml " + quoted(file));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_EQ(check.out, "The same run: 601 steps, digest " + run["digest"].get<std::string>() + "\n");
}

TEST(Replay, RepeatsTheRunOfARobotThatFacesBackwards) {
  // A heading of half a turn is recorded as a matrix, whose angle may be π or -π.
  const auto folder = emptyFolder();
  std::ofstream(folder / "world.xml")
      << "<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size><object><shape><robot>"
         "<model>scout</model><name>R</name><x>0</x><y>0</y><direction>3.141592653589793</direction>"
         "<controller>still</controller></robot></shape></object></surface></world>";
  record(quoted(folder / "world.xml") + " --time 1", folder / "run.rawlog");
  const Ended check =
      runProgram("replay --check " + quoted(folder / "world.xml") + " " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

TEST(Replay, RepeatsTheRunOfRobotsInOtherProcesses) {
  // gold_finder sends messages; wander is not the controller that the world gives.
  for (const std::string controller : {"gold_finder", "wander"}) {
    const auto rawlog = emptyFolder() / "run.rawlog";
    Serving serving({"--wait-for-robots", "--time", "60", "--step-deadline", "600", "--record", rawlog.string()});
    const auto robots = startRobots({"Pioneer1", "Scout1"}, serving.address(), controller);
    EXPECT_EQ(serving.program().wait().exit_code, 0);
    const Ended mail = runProgram("replay --print --sensor INBOX " + quoted(rawlog));
    EXPECT_EQ(mail.exit_code == 0, controller == "gold_finder") << mail.out;
    const Ended check = runProgram("replay --check worlds/small_maze.xml " + quoted(rawlog));
    EXPECT_EQ(check.exit_code, 0) << controller << check.out << check.err;
    EXPECT_TRUE(check.out.starts_with("The same run: ")) << check.out;
  }
}

TEST(Replay, RepeatsARefusedCheckWinAndComparesThePanOfTheLaser) {
  const auto rawlog = emptyFolder() / "run.rawlog";
  Serving serving({"--wait-for-robots", "--time", "0.5", "--step-deadline", "600", "--record", rawlog.string()});
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

TEST(Replay, ReportsTheFirstDifferenceInAChangedWorld) {
  const auto folder = emptyFolder();
  record("worlds/opho2_1.xml --time 100", folder / "run.rawlog");
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

TEST(Replay, PrintsAndRepeatsRangesToBeacons) {
  const auto folder = emptyFolder();
  const auto world = worldWithSensors(folder,
                                      "<sensors><odometry/><sonar><ring count='8' radius_m='0.2'/></sonar>"
                                      "<beacons><noise/><beacon x_m='3' y_m='4'/><beacon x_m='99'/></beacons>"
                                      "</sensors>");
  record(quoted(world) + " --time 2", folder / "run.rawlog");
  const std::string rawlog = quoted(folder / "run.rawlog");
  const Ended check = runProgram("replay --check " + quoted(world) + " " + rawlog);
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  const std::string csv = runProgram("replay --print --csv --sensor beacons " + rawlog).out;
  EXPECT_EQ(csv.rfind("seconds,label,range_0_m\n0.0000000,R/beacons,", 0), 0U) << csv;
  const std::string text = runProgram("replay --print --sensor beacons " + rawlog).out;
  EXPECT_EQ(countOf("s  R/beacons  0: ", text), 21U) << text;
  EXPECT_EQ(countOf(" m\n", text), 21U) << text;
}

TEST(Replay, ControllerRepeatsItsCommandsOnRecordedReadings) {
  const auto file = emptyFolder() / "run.rawlog";
  // Sector sonars, whose echoes are off their axes, and messages: both are restored exactly.
  record("worlds/opho2_1.xml", file);
  const Ended same = runProgram("replay --controller recorded " + quoted(file));
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_EQ(countOf("commands are the recorded ones", same.out), 4U) << same.out;
  const Ended other = runProgram("replay --controller wander --robot Finder1 " + quoted(file));
  EXPECT_EQ(countOf("commands differ", other.out), 1U) << other.out;
  EXPECT_NE(other.out.find("first in step 1 (0.100 s): recorded "), std::string::npos) << other.out;
}

TEST(Replay, ChecksTheReadablePartOfATruncatedRecording) {
  const auto file = emptyFolder() / "run.rawlog";
  record("worlds/opho2_1.xml --time 40", file);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const Ended check = runProgram("replay --check worlds/opho2_1.xml " + quoted(file));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_NE(check.out.find("it is cut off"), std::string::npos) << check.out;
  EXPECT_NE(check.out.find(" steps, is the same."), std::string::npos) << check.out;
  const Ended summary = runProgram("replay " + quoted(file));
  EXPECT_EQ(summary.exit_code, 0);
  EXPECT_NE(summary.out.find("ends early, after "), std::string::npos) << summary.out;
}

TEST(Replay, SummarisesARecordingOfAnotherProgram) {
  const auto file = emptyFolder() / "foreign.rawlog";
  writeForeignRawlog(file);
  const json summary = json::parse(runProgram("replay --json " + quoted(file)).out);
  EXPECT_EQ(summary["observations"], 100);
  EXPECT_NEAR(summary["duration_s"].get<double>(), 9.8, 1e-6);
  EXPECT_NEAR(summary["driven_m"][""].get<double>(), 4.9, 1e-9);
  EXPECT_FALSE(summary.contains("run"));
  const Ended check = runProgram("replay --check worlds/opho2_1.xml " + quoted(file));
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.err.find("contains no world"), std::string::npos) << check.err;
}

TEST(Replay, UsesOneStepPerEntryWithoutTimestamps) {
  const auto file = emptyFolder() / "foreign.rawlog";
  writeOdometry(file, 20, [](int) { return INVALID_TIMESTAMP; });
  const Ended replay = runProgram("replay --json " + quoted(file));
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  const json summary = json::parse(replay.out);
  EXPECT_EQ(summary["observations"], 20);
  EXPECT_NEAR(summary["duration_s"].get<double>(), 1.9, 1e-9);
  const Ended print = runProgram("replay --print --from 1.85 " + quoted(file));
  EXPECT_EQ(print.out, "1.900 s  ODOMETRY  x 1.900 m, y 0.000 m, heading 0.0°\n") << print.err;
  EXPECT_EQ(runProgram("replay " + quoted(file)).out.find("begins"), std::string::npos);
}

TEST(Replay, KeepsTimesThatRunBackwards) {
  const auto file = emptyFolder() / "foreign.rawlog";
  writeOdometry(file, 50, [](int i) { return fiveTimesASecond(49 - i); });
  const json summary = json::parse(runProgram("replay --json " + quoted(file)).out);
  EXPECT_EQ(summary["observations"], 50);
  EXPECT_NEAR(summary["duration_s"].get<double>(), 9.8, 1e-6);
  EXPECT_NEAR(summary["channels"][0]["rate_hz"].get<double>(), 5, 1e-6);
  const Ended print = runProgram("replay --print " + quoted(file));
  EXPECT_EQ(countOf("\n", print.out), 50U);
  EXPECT_NE(print.out.find("\n-9.800 s  ODOMETRY"), std::string::npos) << print.out;
}

TEST(Replay, PrintsObservationsStoredOutOfOrder) {
  const auto file = emptyFolder() / "foreign.rawlog";
  writeOdometry(file, 3, [](int i) { return fiveTimesASecond(i == 1 ? 100 : i); });
  EXPECT_EQ(countOf("\n", runProgram("replay --print --to 10 " + quoted(file)).out), 2U);
}

TEST(Replay, CountsUnlabelledSensorsByClass) {
  const auto file = emptyFolder() / "foreign.rawlog";
  {
    mrpt::io::CFileGZOutputStream stream(file.string());
    auto archive = mrpt::serialization::archiveFrom(stream);
    for (int i = 0; i < 3; ++i) {
      mrpt::obs::CObservationOdometry odometry;
      odometry.timestamp = fiveTimesASecond(i);
      archive << odometry;
    }
    mrpt::obs::CObservation2DRangeScan scan;
    scan.timestamp = fiveTimesASecond(0);
    archive << scan;
  }
  const json summary = json::parse(runProgram("replay --json " + quoted(file)).out);
  ASSERT_EQ(summary["channels"].size(), 2u) << summary;
  EXPECT_EQ(summary["channels"][0]["class"], "CObservation2DRangeScan");
  EXPECT_EQ(summary["channels"][0]["count"], 1);
  EXPECT_EQ(summary["channels"][1]["class"], "CObservationOdometry");
  EXPECT_EQ(summary["channels"][1]["count"], 3);
}

TEST(Replay, ReportsTheDurationOfTheSelection) {
  const auto file = emptyFolder() / "foreign.rawlog";
  writeOdometry(file, 50, fiveTimesASecond);
  const json summary = json::parse(runProgram("replay --json --from 3 --to 5 " + quoted(file)).out);
  EXPECT_EQ(summary["observations"], 11);
  EXPECT_NEAR(summary["duration_s"].get<double>(), 2, 1e-6);
}

TEST(Replay, ListsAvailableNamesWhenTheSelectionIsEmpty) {
  const auto file = emptyFolder() / "run.rawlog";
  record("worlds/small_maze.xml --time 1", file);
  for (const std::string form : {"replay ", "replay --json ", "replay --print "}) {
    EXPECT_EQ(refusal(form + "--robot Unknown " + quoted(file)),
              "robosim: no observation is of robot Unknown; there are Pioneer1, Scout1\n");
    EXPECT_EQ(refusal(form + "--from 10 " + quoted(file)),
              "robosim: no observation matches --robot, --sensor, --from and --to; the recording spans "
              "0.0 s to 1.0 s\n");
  }
  EXPECT_NE(refusal("replay --print --sensor nosuch " + quoted(file))
                .find("no observation is of sensor nosuch; there are GROUND_TRUTH, "),
            std::string::npos);
  EXPECT_NE(refusal("replay --from 3 --to 1 " + quoted(file)).find("--from is later than --to"), std::string::npos);
  EXPECT_NE(refusal("replay --check worlds/small_maze.xml --to 1 " + quoted(file)).find("--to"), std::string::npos);
}

TEST(Replay, PrintsMeasurementsOfEverySensorAsText) {
  const auto folder = emptyFolder();
  record("worlds/small_maze.xml --time 0.1", folder / "run.rawlog");
  const std::string maze = runProgram("replay --print " + quoted(folder / "run.rawlog")).out;
  EXPECT_NE(maze.find("0.000 s  Pioneer1/bumper  on none\n"), std::string::npos) << maze;
  EXPECT_NE(maze.find("0.000 s  Pioneer1/compass  yaw "), std::string::npos) << maze;
  EXPECT_NE(maze.find("0.000 s  Pioneer1/STATUS  command 0.000 m/s, 0.000 rad/s\n"), std::string::npos) << maze;
  const auto line = [&maze](const std::string& label) {
    const auto at = maze.find("0.000 s  Pioneer1/" + label + "  ");
    return maze.substr(at, maze.find('\n', at) - at);
  };
  EXPECT_EQ(countOf("(", line("sonar/POINTS")), 16u) << line("sonar/POINTS");
  EXPECT_EQ(countOf(" ", line("laser")), 5u + 181u)
      << "every range, its unit, and two blanks about the label: " << line("laser");
  EXPECT_EQ(maze.find("CObservation"), std::string::npos) << maze;
  record("worlds/opho2_1.xml", folder / "mail.rawlog");
  const std::string mail = runProgram("replay --print --sensor INBOX " + quoted(folder / "mail.rawlog")).out;
  EXPECT_NE(mail.find("/INBOX  Finder"), std::string::npos) << mail;
  EXPECT_NE(mail.find(": \"GOLD"), std::string::npos) << mail;
}

TEST(Replay, PrintsEveryValueInFullAsCommaSeparatedValues) {
  const auto folder = emptyFolder();
  record("worlds/small_maze.xml --time 0.1", folder / "run.rawlog");
  const auto csv = [&](const std::string& sensor) {
    return runProgram("replay --print --csv --robot Pioneer1 --sensor " + sensor + " " + quoted(folder / "run.rawlog"))
        .out;
  };
  const std::string laser = csv("laser");
  EXPECT_EQ(laser.rfind("seconds,label,range_0_m,range_1_m,", 0), 0u) << laser;
  ASSERT_EQ(countOf("\n", laser), 3u) << "names, and two steps";
  EXPECT_EQ(countOf(",", laser), 3u * (1 + 181));
  EXPECT_NE(laser.find("\n0.0000000,Pioneer1/laser,"), std::string::npos) << laser;
  EXPECT_NE(laser.find("\n0.1000000,Pioneer1/laser,"), std::string::npos) << laser;
  const std::string truth = csv("GROUND_TRUTH");
  EXPECT_EQ(truth.rfind("seconds,label,x_m,y_m,z_m,heading_rad\n0.0000000,Pioneer1/GROUND_TRUTH,", 0), 0u) << truth;
  const std::string status = csv("STATUS");
  EXPECT_EQ(status.rfind("seconds,label,speed_mps,turn_radps,pan_command_rad,activity,by_driver,pan_rad,stalled,"
                         "too_far,has_won\n0.0000000,Pioneer1/STATUS,0,0,0,0,0,0,0,0,0\n",
                         0),
            0u)
      << status;
  EXPECT_NE(refusal("replay --csv " + quoted(folder / "run.rawlog")).find("--print"), std::string::npos);
}

TEST(Replay, WritesTheTruePathOfOneRobotOnly) {
  const auto folder = emptyFolder();
  record("worlds/small_maze.xml --time 1", folder / "run.rawlog");
  const std::string options = " --ground-truth " + quoted(folder / "truth.txt") + " " + quoted(folder / "run.rawlog");
  EXPECT_NE(
      refusal("replay" + options)
          .find("the recording has the true poses of several robots, such as Pioneer1 and Scout1; select one with "
                "--robot NAME"),
      std::string::npos);
  EXPECT_NE(refusal("replay --robot Unknown" + options).find("has no ground truth for the selection"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "truth.txt"));
  ASSERT_EQ(runProgram("replay --robot Scout1" + options).exit_code, 0);
  mrpt::poses::CPose3DInterpolator path;
  ASSERT_TRUE(path.loadFromTextFile((folder / "truth.txt").string()));
  EXPECT_EQ(path.size(), 11u + 2u) << "the first pose stands there three times";
  EXPECT_NEAR(mrpt::Clock::toDouble(path.rbegin()->first), 1104537601.0, 1e-6);
}

TEST(Replay, ExtractsSelectedObservationsForStockTools) {
  const auto folder = emptyFolder();
  record("worlds/small_maze.xml --time 1", folder / "run.rawlog");
  const std::string options = " --output " + quoted(folder / "part.rawlog") + " " + quoted(folder / "run.rawlog");
  EXPECT_NE(refusal("replay --robot Unknown" + options).find("there are Pioneer1, Scout1"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "part.rawlog"));
  const std::string same = quoted(folder / "run.rawlog");
  EXPECT_NE(refusal("replay --output " + same + " " + same).find("is both RAWLOG and --output"), std::string::npos);

  const Ended part = runProgram("replay --robot Scout1 --sensor sonar --sensor odometry --from 0.5" + options);
  ASSERT_EQ(part.exit_code, 0) << part.err;
  EXPECT_NE(part.out.find("part.rawlog: 12 observations\n"), std::string::npos) << part.out;  // 0.5 s, 0.6 s … 1.0 s
  std::vector<std::string> expected, found;
  const auto append = [](std::vector<std::string>& to) {
    return [&to](const mrpt::obs::CObservation::Ptr& observation) {
      std::ostringstream text;
      text << observation->sensorLabel << ' ';
      observation->getDescriptionAsText(text);
      to.push_back(text.str());
    };
  };
  forEachObservation(folder / "run.rawlog", [&](const mrpt::obs::CObservation::Ptr& observation) {
    const std::string& label = observation->sensorLabel;
    const bool is_late = mrpt::Clock::toDouble(observation->timestamp) > 1104537600.45;
    if (is_late && (label == "Scout1/sonar" || label == "Scout1/odometry")) append(expected)(observation);
  });
  forEachObservation(folder / "part.rawlog", append(found));
  EXPECT_EQ(found, expected);
  const ToolRun info = runTool("rawlog-edit --info -i part.rawlog", folder);
  EXPECT_NE(info.output.find("Overall number of objects         : 12"), std::string::npos) << info.output;
}

TEST(Replay, EmbedsExternalPicturesInAnExtract) {
  const auto folder = emptyFolder();
  record("rawlogs/driven.xml --time 1 --record-images external", folder / "run.rawlog");
  const Ended part = runProgram("replay --sensor camera --output " + quoted(folder / "part.rawlog") + " " +
                                quoted(folder / "run.rawlog"));
  ASSERT_EQ(part.exit_code, 0) << part.err;
  std::size_t pictures = 0;
  forEachObservation(folder / "part.rawlog", [&](const mrpt::obs::CObservation::Ptr& observation) {
    const auto& image = dynamic_cast<const mrpt::obs::CObservationImage&>(*observation).image;
    EXPECT_FALSE(image.isExternallyStored());
    EXPECT_EQ(image.getWidth(), 160u);
    ++pictures;
  });
  EXPECT_EQ(pictures, 3u);  // twice a second, from 0 s to 1 s
}

TEST(Replay, EscapesControlCharactersInLabels) {
  const auto file = emptyFolder() / "foreign.rawlog";
  writeOdometry(file, 2, fiveTimesASecond,
                "\x1b[31mred/\xc2\x9b"
                "2Jwheels\a");
  const std::string safe = "\\x1b[31mred/\\x9b2Jwheels\\x07";
  for (const std::string form : {"replay ", "replay --print "}) {
    const Ended replay = runProgram(form + quoted(file));
    EXPECT_NE(replay.out.find(safe), std::string::npos) << form;
    EXPECT_EQ(replay.out.find('\x1b'), std::string::npos) << form;
    EXPECT_EQ(replay.out.find('\a'), std::string::npos) << form;
    EXPECT_EQ(replay.out.find("\xc2\x9b"), std::string::npos) << form;
  }
}

TEST(Replay, ChecksAndReplaysEachFileOfPairsSeparately) {
  const auto folder = emptyFolder();
  const Ended run =
      runProgram("run worlds/opho2_1.xml --json --rawlog-format sf --record " + quoted(folder / "run.rawlog"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json summary = json::parse(run.out);
  const std::string same = "The same run: " + std::to_string(summary["steps"].get<int>() + 1) + " steps, digest " +
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

TEST(Replay, ChecksARunWithoutItsFolderOfPictures) {
  const auto folder = emptyFolder();
  const auto world = folder / "room.xml";
  std::ofstream(world) << R"(<world><surface>
    <size><xmin>0</xmin><xmax>4</xmax><ymin>0</ymin><ymax>4</ymax></size>
    <object><shape><robot><model>pioneer3dx_camera</model><name>Ann</name><x>2</x><y>2</y>
      <controller>wander</controller></robot></shape></object>
  </surface></world>)";
  record(quoted(world) + " --time 0.5 --record-images external", folder / "run.rawlog");
  ASSERT_GT(std::filesystem::remove_all(folder / "run_Images"), 0U);
  const Ended check = runProgram("replay --check " + quoted(world) + " " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_EQ(check.out.rfind("The same run: 6 steps", 0), 0U) << check.out;
}

TEST(Replay, RejectsRecordingsWithoutACompleteStep) {
  const auto folder = emptyFolder();
  record("worlds/opho2_1.xml --time 1", folder / "run.rawlog");
  ASSERT_EQ(
      runCommand("(zcat " + quoted(folder / "run.rawlog") + " > " + quoted(folder / "plain.rawlog") + ")").exit_code,
      0);
  const auto second = textOf(folder / "plain.rawlog").find("CObservationOdometry");
  ASSERT_NE(second, std::string::npos);
  std::filesystem::resize_file(folder / "plain.rawlog", second);
  EXPECT_NE(refusal("replay --check worlds/opho2_1.xml " + quoted(folder / "plain.rawlog"))
                .find("it is cut off; it has no complete step to compare"),
            std::string::npos);
  EXPECT_NE(refusal("replay --controller recorded " + quoted(folder / "plain.rawlog")).find("no command to compare"),
            std::string::npos);
}

TEST(Replay, PrintsNoSummaryWhenInterrupted) {
  const auto folder = emptyFolder();
  writeOdometry(folder / "foreign.rawlog", 50, fiveTimesASecond);
  const std::string bytes = textOf(folder / "foreign.rawlog");
  const auto pipe = folder / "pipe.rawlog";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  StartedProgram replay({"replay", "--json", pipe.string()});
  const int to = open(pipe.c_str(), O_WRONLY);  // blocks until the program reads
  ASSERT_GE(to, 0);
  ASSERT_EQ(write(to, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  replay.interrupt();
  close(to);
  const Ended ended = replay.wait();
  EXPECT_EQ(ended.exit_code, 130);
  EXPECT_EQ(ended.out, "");
  EXPECT_TRUE(ended.err.starts_with("robosim: interrupted; ")) << '"' << ended.err << '"';
}

TEST(Replay, RejectsOtherFilesAndOtherWorlds) {
  const auto folder = emptyFolder();
  const Ended world = runProgram("replay worlds/small_maze.xml");
  EXPECT_EQ(world.exit_code, 1);
  EXPECT_NE(world.err.find("is no MRPT rawlog"), std::string::npos) << world.err;
  EXPECT_NE(runProgram("replay none.rawlog").err.find("none.rawlog: no such file; check the path"), std::string::npos);
  record("worlds/opho2_1.xml --time 1", folder / "run.rawlog");
  const Ended other = runProgram("replay --check worlds/small_maze.xml " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("has 2 robots, and the recording 4"), std::string::npos) << other.err;
}

TEST(Replay, RecordsIdenticalRunsIdentically) {
  const auto folder = emptyFolder();
  for (const char* name : {"one.rawlog", "two.rawlog"}) record("worlds/small_maze.xml --time 20", folder / name);
  EXPECT_EQ(textOf(folder / "one.rawlog"), textOf(folder / "two.rawlog"));
}

}  // namespace
}  // namespace robosim
