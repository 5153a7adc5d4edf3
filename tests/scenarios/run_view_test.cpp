// `robosim run --view` under Xvfb: a run in a window.
#include <cstdlib>
#include <fstream>
#include <optional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/scenarios/program.h"
#include "tests/scenarios/screen.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// 10 m × 10 m: a blue box in the upper right corner, and a red robot in the middle.
fs::path writeHallWithRedRobot(const fs::path& folder) {
  std::ofstream(folder / "hall.xml") << R"(<world><surface>
    <size><xmin>0</xmin><xmax>10</xmax><ymin>0</ymin><ymax>10</ymax></size>
    <object><shape><primitive><cube><name>Box</name><x>8</x><y>8</y><z>0.5</z><length>2</length><width>2</width>
      <height>1</height><color>0 0 1</color></cube></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>5</x><y>5</y><color>1 0 0</color>
      <controller>wander</controller></robot></shape></object>
  </surface></world>)";
  return folder / "hall.xml";
}

/// Mean position of the red pixels [px], which are the robot's once its trail is hidden; nullopt if there is no robot.
std::optional<cv::Point2d> robotIn(const cv::Mat& picture) {
  cv::Mat reds;
  cv::inRange(picture, cv::Scalar(0, 0, 181), cv::Scalar(59, 59, 255), reds);
  if (cv::countNonZero(reds) < 100) return std::nullopt;
  const cv::Moments moments = cv::moments(reds, true);
  return cv::Point2d(moments.m10 / moments.m00, moments.m01 / moments.m00);
}

StartedProgram startRunInWindow(const fs::path& world, const std::vector<std::string>& more) {
  std::vector<std::string> words{"run", world.string(), "--view", "--json"};
  words.insert(words.end(), more.begin(), more.end());
  return StartedProgram(words);
}

/// Waits until the window shows the blue box.
void waitForWindow(const Screen& screen, StartedProgram& run) {
  ASSERT_GT(screen.waitForPixels(2000, bluesIn, run), 2000) << run.error();
}

std::string endedBy(const Ended& run) { return nlohmann::json::parse(run.out)["ended_by"]; }

TEST(RunView, ShowsTheRobotsMovingAndEndsTheRunWhenTheWindowIsClosed) {
  const auto folder = emptyFolder();
  const Screen screen;
  const auto rawlog = folder / "run.rawlog";
  auto run = startRunInWindow(writeHallWithRedRobot(folder),
                              {"--speed", "10", "--time", "100000", "--record", rawlog.string()});
  waitForWindow(screen, run);
  screen.act(Screen::keys("t v"));
  std::optional<cv::Point2d> first, now;
  screen.waitFor(
      [&](const cv::Mat& seen) {
        now = robotIn(seen);
        if (!first) first = now;
        return now && cv::norm(*now - *first) > 50;  // several times its length
      },
      run);
  screen.act(Screen::keys("q"));
  const Ended ended = run.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(endedBy(ended), "window_closed");
  const Ended repeated = runProgram("replay " + quoted(rawlog) + " --check " + quoted(folder / "hall.xml"));
  EXPECT_EQ(repeated.exit_code, 0) << repeated.out << repeated.err;
}

TEST(RunView, StaysOpenAtTheEndOfTheRun) {
  const auto folder = emptyFolder();
  const Screen screen;
  // The first repaint takes the only step.
  auto run = startRunInWindow(writeHallWithRedRobot(folder), {"--speed", "max", "--time", "0.1"});
  waitForWindow(screen, run);
  screen.act(Screen::keys("space plus s"));  // without effect
  EXPECT_TRUE(run.isRunning());
  screen.act(Screen::keys("q"));
  const Ended ended = run.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(endedBy(ended), "time_limit");
  EXPECT_EQ(nlohmann::json::parse(ended.out)["steps"], 1);
}

TEST(RunView, PrintsTheSummaryWhenInterrupted) {
  const auto folder = emptyFolder();
  const Screen screen;
  auto run = startRunInWindow(writeHallWithRedRobot(folder), {"--time", "100000"});
  waitForWindow(screen, run);
  run.interrupt();
  const Ended ended = run.wait();
  EXPECT_EQ(ended.exit_code, 130) << ended.err;
  EXPECT_EQ(endedBy(ended), "interrupted");
}

TEST(RunView, ReportsThatThereIsNoScreen) {
  unsetenv("DISPLAY");
  const auto folder = emptyFolder();
  const Ended ended = runProgram("run " + quoted(writeHallWithRedRobot(folder)) + " --view");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.err.find("there is no screen to open a window on (DISPLAY is not set)"), std::string::npos)
      << ended.err;
}

}  // namespace
}  // namespace robosim
