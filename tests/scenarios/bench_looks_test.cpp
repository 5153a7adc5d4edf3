// What is measured of cameras, views and maps: small loads, so that they are known to run.
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/program.h"

namespace robosim {
namespace {

using nlohmann::json;

TEST(BenchCamera, TellsHowManyPicturesASecondItTakesOfEachSize) {
  const Ended bench = runProgram("bench camera worlds/small_maze.xml --at-least 0.01 --json");
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  std::vector<int> widths;
  std::istringstream lines(bench.out);
  for (std::string line; std::getline(lines, line);) {
    const json figures = json::parse(line);
    widths.push_back(figures["width_px"]);
    EXPECT_GT(figures["pictures_per_cpu_s"], 0.0);
    EXPECT_GT(figures["bytes"], 500.0);
  }
  EXPECT_EQ(widths, (std::vector<int>{160, 320, 640}));
}

TEST(BenchView, TellsHowManyFramesASecondEachKindOfViewHas) {
  const Ended bench = runProgram("bench view --robots 20 --at-least 0.01 --json");
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
  EXPECT_EQ(views, (std::vector<std::string>{"2d", "3d", "both"}));
}

TEST(BenchMaps, EndsWhenInterruptedAndLeavesNothingBehind) {
  const auto folder = emptyFolder();
  const auto is_empty = [&] { return std::filesystem::is_empty(folder); };
  setenv("TMPDIR", folder.c_str(), 1);
  StartedProgram bench({"bench", "maps", "--side", "4000"});
  unsetenv("TMPDIR");
  while (is_empty() && bench.isRunning()) std::this_thread::yield();
  bench.interrupt();
  const Ended ended = bench.wait();
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err, "robosim: interrupted before all was measured\n");
  EXPECT_TRUE(is_empty());
}

TEST(BenchMaps, TellsHowLongMapsOfSeveralKindsTakeToLoad) {
  const Ended bench = runProgram("bench maps --side 200 --json");
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
