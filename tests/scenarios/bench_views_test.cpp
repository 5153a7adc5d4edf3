// `robosim_bench camera`, `raycast`, `view`, `network`, `recording` and `maps` with small loads.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/benchmark.h"

namespace robosim {
namespace {

using nlohmann::json;

TEST(BenchCamera, ReportsPicturesPerSecondForEachSize) {
  const Ended bench = runBenchmark("camera worlds/small_maze.xml --min-time 0.01 --json");
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  std::vector<int> widths;
  std::istringstream lines(bench.out);
  for (std::string line; std::getline(lines, line);) {
    const json figures = json::parse(line);
    widths.push_back(figures["width_px"]);
    EXPECT_GT(figures["pictures_per_cpu_s"], 0.0);
    EXPECT_GT(figures["bytes"], 500.0);
  }
  EXPECT_EQ(widths, (std::vector<int>{160, 320, 320, 640})) << "of 320 also antialiased";
}

TEST(BenchRaycast, ReportsPicturesAndBeamsPerSecond) {
  const Ended bench = runBenchmark("raycast --min-time 1e-3 --json");
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  std::vector<std::string> units;
  std::istringstream lines(bench.out);
  for (std::string line; std::getline(lines, line);) {
    const json figures = json::parse(line);
    units.push_back(figures["unit"]);
    EXPECT_GT(figures["per_cpu_s"], 0.0);
  }
  EXPECT_EQ(std::count(units.begin(), units.end(), "pictures"), 5);
  EXPECT_EQ(std::count(units.begin(), units.end(), "beams"), 2);
}

TEST(BenchRecording, ReportsTheSameRunWithAndWithoutARecording) {
  const Ended bench = runBenchmark("recording worlds/small_maze.xml --time 1 --min-time 1e-3 --json");
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  const json figures = json::parse(bench.out);
  for (const char* kind : {"plain", "rawlog", "mcap"}) EXPECT_GT(figures[kind]["cpu_s"], 0.0) << kind;
  EXPECT_GT(figures["mcap_bytes"], figures["rawlog_bytes"]) << "the same, and topics";
}

TEST(BenchNetwork, ReportsStepsPerSecondOfRobotsInOtherProcesses) {
  const Ended bench = runBenchmark("network --layout 2x1 --windows 1 --window 1e-3 --json");
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  const json figures = json::parse(bench.out);
  EXPECT_EQ(figures["processes"], 2);
  EXPECT_EQ(figures["robots_each"], 1);
  EXPECT_GT(figures["steps_per_s"], 0.0);
}

TEST(BenchNetwork, EndsWhenARobotProcessFails) {
  const auto folder = emptyFolder();
  for (const std::filesystem::path program : {ROBOSIM_PROGRAM, ROBOSIM_BENCH}) {
    std::filesystem::copy_file(program, folder / program.filename());  // but not robosim-net
  }
  const Ended bench = runCommand("'" + (folder / "robosim_bench").string() + "' network --layout 1x1");
  EXPECT_EQ(bench.exit_code, 2);
  EXPECT_NE(bench.err.find("robosim-net: No such file or directory"), std::string::npos) << bench.err;
  EXPECT_NE(bench.err.find("a robot process has ended"), std::string::npos) << bench.err;
}

TEST(BenchView, ReportsFramesPerSecondForEachKindOfView) {
  const Ended bench = runBenchmark("view --robots 20 --min-time 0.01 --json");
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  std::vector<std::string> views;
  std::istringstream lines(bench.out);
  for (std::string line; std::getline(lines, line);) {
    const json figures = json::parse(line);
    views.push_back(figures["view"]);
    EXPECT_EQ(figures["robots"], 20);
    EXPECT_GT(figures["frames_per_s"], 0.0);
    EXPECT_GT(figures["cpu_s_per_frame"], 0.0);
  }
  EXPECT_EQ(views, (std::vector<std::string>{"2d", "2d-bare", "2d-paths", "2d-ranges", "2d-names", "2d-inset", "3d",
                                             "3d-paths", "3d-ranges", "3d-names", "3d-inset", "3d-antialias", "both"}));
}

TEST(BenchMaps, EndsOnInterruptWithoutLeavingFiles) {
  const auto folder = emptyFolder();
  setenv("TMPDIR", folder.c_str(), 1);
  StartedProgram bench(ROBOSIM_BENCH, {"maps", "--side", "4000"});
  unsetenv("TMPDIR");
  bench.waitForFileIn(folder);
  bench.interrupt();
  const Ended ended = bench.wait();
  EXPECT_EQ(ended.exit_code, 130);
  EXPECT_EQ(ended.err, "robosim_bench maps: interrupted before all was measured\n");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(BenchMaps, ReportsLoadTimesForSeveralKindsOfMaps) {
  const Ended bench = runBenchmark("maps --side 200 --json");
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  const json maps = json::parse(bench.out);
  ASSERT_EQ(maps.size(), 5u);
  for (const auto& map : maps) {
    EXPECT_GT(map["load_cpu_s"], 0.0) << map;
    EXPECT_GE(map["occupied"], map["boxes"]) << map;
  }
  EXPECT_EQ(maps[4]["occupied"], (200 * 200 - 20 * 20) / 2) << "every other cell, but for where the robot stands";
}

}  // namespace
}  // namespace robosim
