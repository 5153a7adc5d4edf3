// Robots and objects moved with the mouse, in windows under Xvfb: of `robosim run --view`, and of `robosim view` on a
// served run.
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/scenarios/program.h"
#include "tests/scenarios/screen.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// 10 m × 10 m: a blue box in the upper right corner, and a red robot that stands in the middle.
fs::path writeHallWithStandingRobot(const fs::path& folder) {
  std::ofstream(folder / "hall.xml") << R"(<world><surface>
    <size><xmin>0</xmin><xmax>10</xmax><ymin>0</ymin><ymax>10</ymax></size>
    <object><shape><primitive><cube><name>Box</name><x>8</x><y>8</y><z>0.5</z><length>2</length><width>2</width>
      <height>1</height><color>0 0 1</color></cube></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>5</x><y>5</y><color>1 0 0</color>
      <controller>still</controller></robot></shape></object>
  </surface></world>)";
  return folder / "hall.xml";
}

/// Mean position of the pixels of the box, while nothing covers it.
cv::Point2d boxIn(const cv::Mat& picture) {
  cv::Mat blues;
  cv::inRange(picture, cv::Scalar(200, 0, 0), cv::Scalar(255, 40, 40), blues);
  const cv::Moments moments = cv::moments(blues, true);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

/// A window with only the bodies in its picture.
class MovingWindow {
 public:
  explicit MovingWindow(const std::vector<std::string>& words) : program_(words) {
    EXPECT_GT(screen_.waitForPixels(2000, bluesIn, program_), 2000) << program_.error();
    screen_.act(Screen::keys("t v n"));
    const cv::Mat seen = screen_.shot();
    box_ = boxIn(seen);
    const double px_per_m = std::sqrt(bluesIn(seen)) / 2;
    robot_ = box_ + cv::Point2d(-3, 3) * px_per_m;
  }

  /// Where they were at first.
  const cv::Point2d& box() const { return box_; }
  const cv::Point2d& robot() const { return robot_; }

  void drag(const cv::Point2d& from, const cv::Point2d& to) const {
    const auto move = [](const cv::Point2d& at) {
      return "mousemove --window %1 " + std::to_string(std::lround(at.x)) + " " + std::to_string(std::lround(at.y)) +
             " ";
    };
    screen_.act("windowfocus keydown ctrl " + move(from) + "mousedown 1 " + move((from + to) / 2) + move(to) +
                "mouseup 1 keyup ctrl");
  }
  void press(const std::string& keys) const { screen_.act(Screen::keys(keys)); }
  /// Whether the middle of the box comes within three pixels of a place.
  bool boxComesTo(const cv::Point2d& place) {
    const auto is_there = [&](const cv::Mat& seen) { return cv::norm(boxIn(seen) - place) < 3; };
    return is_there(screen_.waitFor(is_there, program_));
  }
  /// Whether a notice appears above the bar.
  bool showsNotice() {
    const auto is_there = [](const cv::Mat& seen) { return pixelsBetween(seen, {50, 42, 38}, {68, 62, 58}) > 2000; };
    return is_there(screen_.waitFor(is_there, program_));
  }
  Ended quit() {
    press("q");
    return program_.wait();
  }

 private:
  Screen screen_;
  StartedProgram program_;
  cv::Point2d box_, robot_;
};

TEST(ViewMoving, PlacesABodyOfARunAndUndoesItInARunThatCanBeRepeated) {
  const auto folder = emptyFolder();
  const auto world = writeHallWithStandingRobot(folder), rawlog = folder / "run.rawlog";
  MovingWindow window({"run", world.string(), "--view", "--json", "--time", "100000", "--record", rawlog.string()});
  const cv::Point2d aside(-100, 150);
  window.drag(window.box(), window.box() + aside);
  EXPECT_TRUE(window.boxComesTo(window.box() + aside));
  window.drag(window.box() + aside, window.robot());  // overlaps the robot: it stays
  EXPECT_TRUE(window.showsNotice());
  EXPECT_TRUE(window.boxComesTo(window.box() + aside));
  window.press("ctrl+z");
  EXPECT_TRUE(window.boxComesTo(window.box()));
  window.drag(window.robot(), window.robot() - aside);
  const Ended ended = window.quit();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(nlohmann::json::parse(ended.out)["interventions"], 3) << ended.out;
  const Ended repeated = runProgram("replay " + quoted(rawlog) + " --check " + quoted(world));
  EXPECT_EQ(repeated.exit_code, 0) << repeated.out << repeated.err;
}

TEST(ViewMoving, NeedsASupervisorsTokenInAServedRunThatRequiresTokens) {
  const auto folder = emptyFolder();
  const auto world = writeHallWithStandingRobot(folder), tokens = folder / "tokens";
  std::ofstream(tokens) << "watcher_0123456789 viewer name=watcher\nreferee_0123456789 supervisor name=referee\n";
  fs::permissions(tokens, fs::perms::owner_read | fs::perms::owner_write);
  Serving serving({"--paused", "--tokens", tokens.string()}, world.string());
  const cv::Point2d aside(-100, 150);
  {
    setenv("ROBOSIM_TOKEN", "watcher_0123456789", 1);
    MovingWindow window({"view", serving.address(), "--size", "900x700"});
    window.drag(window.box(), window.box() + aside);
    EXPECT_TRUE(window.showsNotice());
    EXPECT_TRUE(window.boxComesTo(window.box()));
    window.drag(window.box(), window.box() + aside);
    EXPECT_EQ(window.quit().exit_code, 0);
  }
  setenv("ROBOSIM_TOKEN", "referee_0123456789", 1);
  MovingWindow window({"view", serving.address(), "--size", "900x700"});
  unsetenv("ROBOSIM_TOKEN");
  window.drag(window.box(), window.box() + aside);
  EXPECT_TRUE(window.boxComesTo(window.box() + aside));
  window.press("u");
  EXPECT_TRUE(window.boxComesTo(window.box()));
  EXPECT_EQ(window.quit().exit_code, 0);
  serving.program().interrupt();
  const Ended served = serving.program().wait();
  EXPECT_EQ(countOf(": supervise <place name=\"Box\"", served.err), 2u) << served.err;
  EXPECT_EQ(countOf("has the role viewer", served.err), 1u) << "asked for once: " << served.err;
}

}  // namespace
}  // namespace robosim
