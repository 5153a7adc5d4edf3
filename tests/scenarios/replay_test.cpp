// `robosim replay` on recordings of our own, damaged ones, and somebody else's.

#include <filesystem>
#include <fstream>
#include <functional>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <mrpt/system/datetime.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/scenarios/foreign_rawlog.h"
#include "tests/scenarios/program.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

using nlohmann::json;

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

/// Runs a world, recorded. @return the summary
json record(const std::string& arguments, const std::filesystem::path& file) {
  const Ended run = runProgram("run " + arguments + " --json --record " + quoted(file));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return json::parse(run.out);
}

/// Odometry of a stranger's robot, with such timestamps.
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

/// What the program says is wrong.
std::string refusal(const std::string& arguments) {
  const Ended ended = runProgram(arguments);
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  return ended.err;
}

TEST(Replay, SummarisesWhatTheRobotsSensedAndHowTheRunEnded) {
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

TEST(Replay, ShowsOnlyTheRobotsSensorsAndTimesAskedFor) {
  const auto file = emptyFolder() / "run.rawlog";
  record("worlds/opho2_1.xml --time 5", file);
  const Ended one = runProgram("replay --print --robot Finder2 --sensor heat --from 1 --to 1.2 " + quoted(file));
  EXPECT_EQ(countOf("\n", one.out), 3U) << one.out;
  EXPECT_EQ(countOf("Finder2/heat", one.out), 3U) << one.out;
  EXPECT_EQ(one.out.rfind("1.000 s  Finder2/heat", 0), 0U) << one.out;
}

TEST(Replay, RunsTheWorldAgainAndItIsTheSameRun) {
  const auto file = emptyFolder() / "run.rawlog";
  const json run = record("worlds/opho2_1.xml --seed 4 --time 60", file);
  const Ended check = runProgram("replay --check worlds/opho2_1.xml " + quoted(file));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_EQ(check.out, "The same run: 601 steps, digest " + run["digest"].get<std::string>() + "\n");
}

TEST(Replay, TellsTheFirstStepAndReadingThatDifferInAChangedWorld) {
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

TEST(Replay, AControllerDecidesOnRecordedReadingsAsItDidThen) {
  const auto file = emptyFolder() / "run.rawlog";
  // Sector sonars, whose echoes come from beside their axes, and mail: both come back to the last bit.
  record("worlds/opho2_1.xml", file);
  const Ended same = runProgram("replay --controller recorded " + quoted(file));
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_EQ(countOf("commands are the recorded ones", same.out), 4U) << same.out;
  const Ended other = runProgram("replay --controller wander --robot Finder1 " + quoted(file));
  EXPECT_EQ(countOf("commands differ", other.out), 1U) << other.out;
  EXPECT_NE(other.out.find("first in step 1 (0.100 s): recorded "), std::string::npos) << other.out;
}

TEST(Replay, OfARecordingThatIsCutOffChecksWhatThereIs) {
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

TEST(Replay, SummarisesSomebodyElsesRecording) {
  const auto file = emptyFolder() / "foreign.rawlog";
  writeForeignRawlog(file);
  const json summary = json::parse(runProgram("replay --json " + quoted(file)).out);
  EXPECT_EQ(summary["observations"], 100);
  EXPECT_NEAR(summary["duration_s"].get<double>(), 9.8, 1e-6);
  EXPECT_NEAR(summary["driven_m"][""].get<double>(), 4.9, 1e-9);
  EXPECT_FALSE(summary.contains("run"));
  const Ended check = runProgram("replay --check worlds/opho2_1.xml " + quoted(file));
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.err.find("does not say which world it is of"), std::string::npos) << check.err;
}

TEST(Replay, ARecordingWithoutTimestampsHasAStepForEachEntry) {
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

TEST(Replay, TimesThatRunBackwardsAreAllThere) {
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

TEST(Replay, WhatIsLateInTheFileButEarlyInTimeIsPrintedToo) {
  const auto file = emptyFolder() / "foreign.rawlog";
  writeOdometry(file, 3, [](int i) { return fiveTimesASecond(i == 1 ? 100 : i); });
  EXPECT_EQ(countOf("\n", runProgram("replay --print --to 10 " + quoted(file)).out), 2U);
}

TEST(Replay, TheDurationIsThatOfWhatWasAskedFor) {
  const auto file = emptyFolder() / "foreign.rawlog";
  writeOdometry(file, 50, fiveTimesASecond);
  const json summary = json::parse(runProgram("replay --json --from 3 --to 5 " + quoted(file)).out);
  EXPECT_EQ(summary["observations"], 11);
  EXPECT_NEAR(summary["duration_s"].get<double>(), 2, 1e-6);
}

TEST(Replay, SaysWhatThereIsWhenNothingIsOfWhatWasAskedFor) {
  const auto file = emptyFolder() / "run.rawlog";
  record("worlds/small_maze.xml --time 1", file);
  for (const std::string form : {"replay ", "replay --json ", "replay --print "}) {
    EXPECT_EQ(refusal(form + "--robot Nobody " + quoted(file)),
              "robosim: no observation is of robot Nobody; there are Pioneer1, Scout1\n");
    EXPECT_EQ(refusal(form + "--from 10 " + quoted(file)),
              "robosim: no observation is what --robot, --sensor, --from and --to ask for; the recording goes from "
              "0.0 s to 1.0 s\n");
  }
  EXPECT_NE(refusal("replay --print --sensor nosuch " + quoted(file))
                .find("no observation is of sensor nosuch; there are GROUND_TRUTH, "),
            std::string::npos);
  EXPECT_NE(refusal("replay --from 3 --to 1 " + quoted(file)).find("--from is later than --to"), std::string::npos);
  EXPECT_NE(refusal("replay --check worlds/small_maze.xml --to 1 " + quoted(file)).find("--to"), std::string::npos);
}

TEST(Replay, PrintsWhatEverySensorMeasuredInWords) {
  const auto folder = emptyFolder();
  record("worlds/small_maze.xml --time 0.1", folder / "run.rawlog");
  const std::string maze = runProgram("replay --print " + quoted(folder / "run.rawlog")).out;
  EXPECT_NE(maze.find("0.000 s  Pioneer1/bumper  on none\n"), std::string::npos) << maze;
  EXPECT_NE(maze.find("0.000 s  Pioneer1/compass  yaw "), std::string::npos) << maze;
  EXPECT_NE(maze.find("0.000 s  Pioneer1/STATUS  command 0.000 m/s, 0.000 rad/s\n"), std::string::npos) << maze;
  EXPECT_NE(maze.find("0.000 s  Pioneer1/sonar/POINTS  16 points\n"), std::string::npos) << maze;
  EXPECT_EQ(maze.find("CObservation"), std::string::npos) << maze;
  record("worlds/opho2_1.xml", folder / "mail.rawlog");
  const std::string mail = runProgram("replay --print --sensor INBOX " + quoted(folder / "mail.rawlog")).out;
  EXPECT_NE(mail.find("/INBOX  Finder"), std::string::npos) << mail;
  EXPECT_NE(mail.find(": \"GOLD"), std::string::npos) << mail;
}

TEST(Replay, AStrangersLabelDoesNotSteerTheTerminal) {
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

TEST(Replay, EachRobotsFileOfPairsIsCheckedAndReplayedByItself) {
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

TEST(Replay, ChecksARunWhoseFolderOfPicturesIsNotThere) {
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

TEST(Replay, WhereThereIsNoWholeStepNothingIsCalledTheSame) {
  const auto folder = emptyFolder();
  record("worlds/opho2_1.xml --time 1", folder / "run.rawlog");
  ASSERT_EQ(
      runCommand("(zcat " + quoted(folder / "run.rawlog") + " > " + quoted(folder / "plain.rawlog") + ")").exit_code,
      0);
  const auto second = textOf(folder / "plain.rawlog").find("CObservationOdometry");
  ASSERT_NE(second, std::string::npos);
  std::filesystem::resize_file(folder / "plain.rawlog", second);
  EXPECT_NE(refusal("replay --check worlds/opho2_1.xml " + quoted(folder / "plain.rawlog"))
                .find("it is cut off; it has no whole step to compare"),
            std::string::npos);
  EXPECT_NE(refusal("replay --controller recorded " + quoted(folder / "plain.rawlog")).find("no command to compare"),
            std::string::npos);
}

TEST(Replay, ASummaryThatIsInterruptedIsNone) {
  const auto folder = emptyFolder();
  writeOdometry(folder / "foreign.rawlog", 50, fiveTimesASecond);
  const std::string bytes = textOf(folder / "foreign.rawlog");
  const auto pipe = folder / "pipe.rawlog";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  StartedProgram replay({"replay", "--json", pipe.string()});
  const int to = open(pipe.c_str(), O_WRONLY);  // waits until it reads, for which it waits until this is closed
  ASSERT_GE(to, 0);
  ASSERT_EQ(write(to, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  replay.interrupt();
  close(to);
  const Ended ended = replay.wait();
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(ended.err, "robosim: interrupted; only the first 0.0 s of the recording were read\n");
}

TEST(Replay, RefusesWhatIsNoRecordingAndAnotherWorld) {
  const auto folder = emptyFolder();
  const Ended world = runProgram("replay worlds/small_maze.xml");
  EXPECT_EQ(world.exit_code, 1);
  EXPECT_NE(world.err.find("is no MRPT rawlog"), std::string::npos) << world.err;
  EXPECT_NE(runProgram("replay none.rawlog").err.find("No such file"), std::string::npos);
  record("worlds/opho2_1.xml --time 1", folder / "run.rawlog");
  const Ended other = runProgram("replay --check worlds/small_maze.xml " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("has 2 robots, and the recording 4"), std::string::npos) << other.err;
}

TEST(Replay, TheSameRunIsTheSameRecordingByteForByte) {
  const auto folder = emptyFolder();
  for (const char* name : {"one.rawlog", "two.rawlog"}) record("worlds/small_maze.xml --time 20", folder / name);
  EXPECT_EQ(textOf(folder / "one.rawlog"), textOf(folder / "two.rawlog"));
}

}  // namespace
}  // namespace robosim
