// `robosim replay` on recordings of RoboSim and of other programs: summaries, texts and extracts.

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

#include "tests/scenarios/foreign_rawlog.h"
#include "tests/scenarios/recorded_run.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

using nlohmann::json;

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

TEST(Replay, SummarisesSensorsAndOutcome) {
  const auto file = emptyFolder() / "run.rawlog";
  const json run = recordRun("worlds/small_maze.xml --seed 3", file);
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
  recordRun("worlds/opho2_1.xml --time 5", file);
  const Ended one = runProgram("replay --print --robot Finder2 --sensor heat --from 1 --to 1.2 " + quoted(file));
  EXPECT_EQ(countOf("\n", one.out), 3U) << one.out;
  EXPECT_EQ(countOf("Finder2/heat", one.out), 3U) << one.out;
  EXPECT_EQ(one.out.rfind("1.000 s  Finder2/heat", 0), 0U) << one.out;
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
  recordRun("worlds/small_maze.xml --time 1", file);
  for (const std::string form : {"replay ", "replay --json ", "replay --print "}) {
    EXPECT_EQ(refusalOf(form + "--robot Unknown " + quoted(file)),
              "robosim replay: no observation is of robot Unknown; there are Pioneer1, Scout1\n");
    EXPECT_EQ(refusalOf(form + "--from 10 " + quoted(file)),
              "robosim replay: no observation matches --robot, --sensor, --from and --to; the recording spans "
              "0.0 s to 1.0 s\n");
  }
  EXPECT_NE(refusalOf("replay --print --sensor nosuch " + quoted(file))
                .find("no observation is of sensor nosuch; there are GROUND_TRUTH, "),
            std::string::npos);
  EXPECT_NE(refusalOf("replay --from 3 --to 1 " + quoted(file)).find("--from is later than --to"), std::string::npos);
  EXPECT_NE(refusalOf("replay --check worlds/small_maze.xml --to 1 " + quoted(file)).find("--to"), std::string::npos);
}

TEST(Replay, PrintsMeasurementsOfEverySensorAsText) {
  const auto folder = emptyFolder();
  recordRun("worlds/small_maze.xml --time 0.1", folder / "run.rawlog");
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
  recordRun("worlds/opho2_1.xml", folder / "mail.rawlog");
  const std::string mail = runProgram("replay --print --sensor INBOX " + quoted(folder / "mail.rawlog")).out;
  EXPECT_NE(mail.find("/INBOX  Finder"), std::string::npos) << mail;
  EXPECT_NE(mail.find(": \"GOLD"), std::string::npos) << mail;
}

TEST(Replay, PrintsEveryValueInFullAsCommaSeparatedValues) {
  const auto folder = emptyFolder();
  recordRun("worlds/small_maze.xml --time 0.1", folder / "run.rawlog");
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
  EXPECT_EQ(
      status.rfind(
          "seconds,label,speed_mps,turn_radps,pan_command_rad,activity,by_driver,emergency_stop,grip,led_color,pan_rad,"
          "stalled,too_far,has_won\n0.0000000,Pioneer1/STATUS,0,0,0,0,0,0,0,0,0,0,0,0\n",
          0),
      0u)
      << status;
  EXPECT_NE(refusalOf("replay --csv " + quoted(folder / "run.rawlog")).find("--print"), std::string::npos);
}

TEST(Replay, NeedsAnIndexToPrintIt) {
  const auto folder = emptyFolder();
  recordRun("worlds/small_maze.xml --time 1", folder / "run.rawlog");
  EXPECT_NE(refusalOf("replay --index " + quoted(folder / "run.rawlog"))
                .find("--index reads the index of an .mcap file; omit it to read the whole recording"),
            std::string::npos);
  recordRun("worlds/small_maze.xml --time 1", folder / "run.mcap");
  std::filesystem::resize_file(folder / "run.mcap", std::filesystem::file_size(folder / "run.mcap") - 1);
  EXPECT_NE(refusalOf("replay --index " + quoted(folder / "run.mcap"))
                .find("has no index with statistics, as a file that is cut off; omit --index"),
            std::string::npos);
}

TEST(Replay, WritesTheTruePathOfOneRobotOnly) {
  const auto folder = emptyFolder();
  recordRun("worlds/small_maze.xml --time 1", folder / "run.rawlog");
  const std::string options = " --ground-truth " + quoted(folder / "truth.txt") + " " + quoted(folder / "run.rawlog");
  EXPECT_NE(
      refusalOf("replay" + options)
          .find("the recording has the true poses of several robots, such as Pioneer1 and Scout1; select one with "
                "--robot NAME"),
      std::string::npos);
  EXPECT_NE(refusalOf("replay --robot Unknown" + options).find("has no ground truth for the selection"),
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
  recordRun("worlds/small_maze.xml --time 1", folder / "run.rawlog");
  const std::string options = " --output " + quoted(folder / "part.rawlog") + " " + quoted(folder / "run.rawlog");
  EXPECT_NE(refusalOf("replay --robot Unknown" + options).find("there are Pioneer1, Scout1"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "part.rawlog"));
  const std::string same = quoted(folder / "run.rawlog");
  EXPECT_NE(refusalOf("replay --output " + same + " " + same).find("is both RAWLOG and --output"), std::string::npos);

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
  recordRun("rawlogs/driven.xml --time 1 --record-images external", folder / "run.rawlog");
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
  EXPECT_TRUE(ended.err.starts_with("robosim replay: interrupted; ")) << '"' << ended.err << '"';
}

}  // namespace
}  // namespace robosim
