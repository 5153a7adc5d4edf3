// `robosim view`: pictures of worlds, recordings and runs, and a window under Xvfb.

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <malloc.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/scenarios/foreign_rawlog.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/screen.h"
#include "tests/scenarios/serving.h"
#include "tests/scenarios/wait.h"
#include "viewing/recorded_moments.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

/// 10 m × 10 m: a blue box of 2 m × 2 m in the upper right quarter, a red robot in the middle.
fs::path writeHall(const fs::path& folder) {
  std::ofstream(folder / "hall.xml") << R"(<world><surface>
    <size><xmin>0</xmin><xmax>10</xmax><ymin>0</ymin><ymax>10</ymax></size>
    <object><shape><primitive><cube><name>Box</name><x>8</x><y>8</y><z>0.5</z><length>2</length><width>2</width>
      <height>1</height><color>0 0 1</color></cube></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>5</x><y>5</y><color>1 0 0</color>
      <controller>wander</controller></robot></shape></object>
  </surface></world>)";
  return folder / "hall.xml";
}

/// With --size 648x648, 10 m are 600 px between margins of 24.
cv::Vec3b atMetres(const cv::Mat& picture, double x, double y) {
  return picture.at<cv::Vec3b>(static_cast<int>(24 + (10 - y) * 60), static_cast<int>(24 + x * 60));
}

TEST(View, WritesAPictureOfAWorldFromAboveToScale) {
  const auto folder = emptyFolder();
  const Ended view =
      runProgram("view " + quoted(writeHall(folder)) + " --size 648x648 --offscreen " + quoted(folder / "hall.png"));
  ASSERT_EQ(view.exit_code, 0) << view.err;
  const cv::Mat picture = cv::imread((folder / "hall.png").string());
  ASSERT_EQ(picture.size(), cv::Size(648, 648));
  for (const double inside : {7.1, 8.9}) EXPECT_TRUE(isBlue(atMetres(picture, inside, inside))) << inside;
  for (const double outside : {6.9, 9.1}) EXPECT_FALSE(isBlue(atMetres(picture, outside, 8))) << outside;
}

TEST(View, AcceptsAnEndingInCapitals) {
  const auto folder = emptyFolder();
  const Ended view =
      runProgram("view " + quoted(writeHall(folder)) + " --size 648x648 --offscreen " + quoted(folder / "hall.PNG"));
  ASSERT_EQ(view.exit_code, 0) << view.err;
  EXPECT_EQ(cv::imread((folder / "hall.PNG").string()).size(), cv::Size(648, 648));
}

TEST(View, WritesPicturesFromAboveAndFromARobot) {
  const auto folder = emptyFolder();
  const Ended view = runProgram("view " + quoted(writeHall(folder)) +
                                " --3d --view 3d@Ann --size 804x400 --offscreen " + quoted(folder / "air.png"));
  ASSERT_EQ(view.exit_code, 0) << view.err;
  const cv::Mat picture = cv::imread((folder / "air.png").string());
  ASSERT_EQ(picture.size(), cv::Size(804, 400));
  const auto blues = [&](const cv::Rect& part) {
    int count = 0;
    for (int y = part.y; y < part.y + part.height; ++y) {
      for (int x = part.x; x < part.x + part.width; ++x) count += isBlue(picture.at<cv::Vec3b>(y, x)) ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(blues({200, 0, 200, 200}), 300) << "the box stands in the upper right quarter, seen from the south";
  EXPECT_EQ(blues({0, 200, 200, 200}), 0);
}

TEST(View, UsesLittleMemoryForALongRecording) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.rawlog";
  ASSERT_EQ(runProgram("run " + quoted(writeHall(folder)) + " --time 300 --record " + quoted(rawlog)).exit_code, 0);
  readMoments(rawlog.string());  // initialises data that is created once per process
  const std::size_t before = mallinfo2().uordblks + mallinfo2().hblkhd;
  const auto moments = readMoments(rawlog.string());
  const std::size_t after = mallinfo2().uordblks + mallinfo2().hblkhd;
  ASSERT_EQ(moments->times().size(), 3001u);
  EXPECT_LT(after, before + 2'000'000) << "the scans alone are 8 MB";
  EXPECT_EQ(moments->at(3000).step, 3000u);
  EXPECT_EQ(moments->at(7).step, 7u);
}

TEST(View, ShowsALiveRunWithoutChangingIt) {
  const auto folder = emptyFolder();
  Serving serving({"--paused"}, "worlds/opho2_1.xml");
  const Ended view =
      runProgram("view " + serving.address() + " --size 400x400 --offscreen " + quoted(folder / "run.png"));
  ASSERT_EQ(view.exit_code, 0) << view.err;
  EXPECT_EQ(cv::imread((folder / "run.png").string()).size(), cv::Size(400, 400));
  EXPECT_TRUE(serving.program().isRunning());
}

TEST(View, ReportsInvalidArguments) {
  const auto folder = emptyFolder();
  const auto hall = quoted(writeHall(folder));
  const auto error = [](const std::string& arguments) {
    const Ended view = runProgram("view " + arguments);
    EXPECT_EQ(view.exit_code, 1) << view.out << view.err;
    return view.err;
  };
  EXPECT_NE(error(hall + " --follow Bob --offscreen x.png").find("there is no robot Bob; there is Ann"),
            std::string::npos);
  EXPECT_NE(error(hall + " --offscreen x.gif")
                .find("must end in .png, for a picture, in .svg or .pdf, for a figure, or in .mp4"),
            std::string::npos);
  EXPECT_NE(error(hall + " --offscreen x.mp4").find("nothing moves in a world that does not run"), std::string::npos);
  EXPECT_NE(error(hall + " --size 10x10 --offscreen x.png").find("--size 10x10: must be"), std::string::npos);
  EXPECT_NE(error(hall + " --view 4d --offscreen x.png").find("--view 4d: must be 2d"), std::string::npos);
  EXPECT_NE(error("worlds --offscreen x.png").find("worlds: is a directory; name a file in it"), std::string::npos);
  EXPECT_NE(error("none.gridmap --offscreen x.png").find("there is no such file"), std::string::npos);
  EXPECT_NE(error("worlds/none.xml --offscreen x.png").find("there is no such file"), std::string::npos);
  EXPECT_NE(error("worlds/small_maze.xml --offscreen worlds/small_maze.xml").find("must end in"), std::string::npos);
  unsetenv("DISPLAY");
  EXPECT_NE(error(hall).find("there is no screen to open a window on"), std::string::npos);
  setenv("DISPLAY", ":nowhere", 1);
  const std::string dead = error(hall);
  unsetenv("DISPLAY");
  EXPECT_NE(dead.find("DISPLAY is :nowhere, which does not answer"), std::string::npos) << dead;
  EXPECT_NE(dead.find("--offscreen view.png"), std::string::npos) << dead;
}

TEST(View, RejectsTimesWithoutEffect) {
  const auto folder = emptyFolder();
  const auto hall = quoted(writeHall(folder)), run = quoted(folder / "run.rawlog");
  ASSERT_EQ(runProgram("run " + hall + " --time 3 --record " + run).exit_code, 0);
  const auto expect_error = [&](const std::string& arguments, const std::string& file, const std::string& text) {
    const Ended view = runProgram("view " + arguments + " --offscreen " + quoted(folder / file));
    EXPECT_EQ(view.exit_code, 1) << arguments;
    EXPECT_NE(view.err.find(text), std::string::npos) << view.err;
    EXPECT_FALSE(fs::exists(folder / file)) << arguments;
  };
  for (const char* file : {"x.mp4", "x.png"}) {
    expect_error(run + " --from 100", file, "--from 100: the recording ends at 3 s");
    expect_error(run + " --from 3 --to 1", file, "--from 3: is later than --to 1");
    expect_error(hall + " --to 1", file, "--to: applies to recordings only");
  }
  expect_error(run + " --speed 2", "x.png", "--speed: applies to videos only");
  expect_error(run + " --for 2", "x.mp4", "--for: applies to videos of live runs only");
}

TEST(View, ChecksTheVideoFileBeforeReading) {
  const auto folder = emptyFolder();
  fs::create_directory(folder / "folder.mp4");
  const Ended is_folder = runProgram("view none.rawlog --offscreen " + quoted(folder / "folder.mp4"));
  EXPECT_EQ(is_folder.exit_code, 1);
  EXPECT_EQ(is_folder.err, "robosim view: " + (folder / "folder.mp4").string() + ": is a folder; name a file in it\n");
  const Ended no_folder = runProgram("view none.rawlog --offscreen " + quoted(folder / "none/x.mp4"));
  EXPECT_EQ(no_folder.exit_code, 1);
  EXPECT_EQ(countOf("\n", no_folder.err), 1u) << no_folder.err;
  EXPECT_NE(no_folder.err.find("does not exist; create it"), std::string::npos) << no_folder.err;
}

TEST(View, ShowsMapsAsWorlds) {
  const auto folder = emptyFolder();
  for (const std::string map : {"lab.yaml", "office.map", "opho2_1.gridmap.gz"}) {
    const Ended view = runProgram("view maps/" + map + " --size 400x400 --offscreen " + quoted(folder / "map.png"));
    ASSERT_EQ(view.exit_code, 0) << view.err;
    const cv::Mat picture = cv::imread((folder / "map.png").string());
    cv::Mat white;
    cv::inRange(picture, cv::Scalar(255, 255, 255), cv::Scalar(255, 255, 255), white);
    EXPECT_GT(cv::countNonZero(white), 1000) << map << " has a floor";
    EXPECT_LT(cv::countNonZero(white), 400 * 400 - 1000) << map << " has walls";
    fs::remove(folder / "map.png");
  }
  const Ended picture = runProgram("view maps/courtyard.png --offscreen " + quoted(folder / "map.png"));
  EXPECT_EQ(picture.exit_code, 1);
  EXPECT_NE(picture.err.find("a picture does not say how large it is"), std::string::npos) << picture.err;
}

TEST(View, OpensAWindowAndClosesOnQ) {
  const auto folder = emptyFolder();
  const auto hall = writeHall(folder);
  const Screen screen;
  StartedProgram view({"view", hall.string(), "--size", "648x684"});  // 648 x 648 above the toolbar
  // Independent of the window's position, a blue square of 120 px appears.
  const int blue = screen.waitForPixels(120 * 120 - 1000, bluesIn, view);
  EXPECT_NEAR(blue, 120 * 120, 1000) << view.error();
  screen.act(Screen::keys("q"));
  const Ended ended = view.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

/// A window on a run, after its first drawing.
class RunWindow {
 public:
  RunWindow(const ServedWorld& world, const std::string& token, const Screen& screen,
            const std::vector<std::string>& more = {})
      : screen_(screen), view_((setenv("ROBOSIM_TOKEN", token.c_str(), 1), words(world, more))) {
    EXPECT_GE(waitUntilLit(), 100'000) << view_.error();
  }
  ~RunWindow() { unsetenv("ROBOSIM_TOKEN"); }
  void press(const std::string& keys) const { screen_.act(Screen::keys(keys)); }
  bool isOpen() { return view_.isRunning(); }
  int waitUntilLit() { return screen_.waitForPixels(100'000, litsIn, view_); }
  /// Waits until a large part of the screen has changed.
  void waitForChange(const cv::Mat& before) {
    screen_.waitFor(
        [&](const cv::Mat& seen) {
          cv::Mat difference, equals;
          cv::absdiff(seen, before, difference);
          cv::inRange(difference, cv::Scalar(0, 0, 0), cv::Scalar(0, 0, 0), equals);
          return cv::countNonZero(equals) <= 1024 * 768 - 20'000;
        },
        view_);
  }
  Ended quit() {
    press("q");
    return view_.wait();
  }

 private:
  static std::vector<std::string> words(const ServedWorld& world, const std::vector<std::string>& more) {
    std::vector<std::string> words{"view", world.connectOptions().address};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  const Screen& screen_;
  StartedProgram view_;
};

TEST(View, PausesAndStepsARunForOperatorsOnly) {
  const std::string watcher = "viewer-0123456789ab", master = "master-0123456789ab";
  ServedWorld::Options options;
  options.server.access = Access::parse(watcher + " viewer\n" + master + " operator\n", "tokens");
  options.server.speed = 1;
  ServedWorld world(options);
  ConnectOptions connect_options = world.connectOptions();
  connect_options.token = master;
  ControlPanel panel(connect_options);
  const Screen screen;
  {
    RunWindow window(world, watcher, screen);
    window.press("space");
    EXPECT_EQ(window.quit().exit_code, 0);
    EXPECT_EQ(panel.status().phase(), v1::RUN_PHASE_RUNNING);
  }
  RunWindow window(world, master, screen);
  window.press("space");
  while (window.isOpen() && panel.status().phase() != v1::RUN_PHASE_PAUSED) {
  }
  const auto step = panel.status().step();
  window.press("s");
  while (window.isOpen() && panel.status().step() == step) {
  }
  EXPECT_EQ(panel.status().step(), step + 1);
  EXPECT_EQ(panel.status().phase(), v1::RUN_PHASE_PAUSED);
  window.press("space");
  while (window.isOpen() && panel.status().phase() != v1::RUN_PHASE_RUNNING) {
  }
  EXPECT_EQ(window.quit().exit_code, 0);
}

TEST(View, SlowsAnUnlimitedRunToRealTimeButNeverSpeedsItUp) {
  ServedWorld world({});
  Panel panel(world);
  const Screen screen;
  RunWindow window(world, "", screen);
  EXPECT_EQ(panel.status().speed(), 0);
  window.press("plus");
  window.press("minus");
  while (window.isOpen() && panel.status().speed() == 0) {
  }
  EXPECT_EQ(panel.status().speed(), 1);
  EXPECT_EQ(window.quit().exit_code, 0);
}

TEST(View, StaysOpenAfterTheEndOfTheRun) {
  ServedWorld::Options options;
  options.server.speed = 1;
  ServedWorld world(options);
  const Screen screen;
  RunWindow window(world, "", screen);
  Panel(world).stop();
  EXPECT_EQ(world.wait(), Served::stopped);
  for (const char* key : {"space", "s", "plus", "minus"}) window.press(key);
  EXPECT_GE(window.waitUntilLit(), 100'000);
  const Ended ended = window.quit();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(withoutDesktopMessages(ended.err), "");
}

TEST(View, StaysOpenWithTheReasonWhenTheServerEnds) {
  const Screen screen;
  auto serving = std::make_unique<Serving>(std::vector<std::string>{"--speed", "1", "--controller", "wander"},
                                           "worlds/opho2_1.xml");
  StartedProgram view({"view", serving->address(), "--size", "800x600"});
  ASSERT_GE(screen.waitForPixels(100'000, litsIn, view), 100'000) << view.error();
  serving.reset();  // ends the server's process
  const auto reds_in = [](const cv::Mat& seen) { return pixelsBetween(seen, {0, 0, 141}, {59, 59, 255}); };
  EXPECT_GE(screen.waitForPixels(20'000, reds_in, view), 20'000) << "a banner; " << view.error();
  EXPECT_TRUE(view.isRunning());
  screen.act(Screen::keys("q"));
  const Ended ended = view.wait();
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_NE(ended.err.find("robosim view: "), std::string::npos) << "the reason is printed, too: " << ended.err;
}

TEST(View, ContinuesWithAWorldWithoutTheFollowedRobot) {
  const std::string master = "master-0123456789ab";
  ServedWorld::Options options;
  options.server.access = Access::parse(master + " operator\n", "tokens");
  options.server.is_paused = true;
  ServedWorld world(options);
  ConnectOptions connect_options = world.connectOptions();
  connect_options.token = master;
  ControlPanel panel(connect_options);
  const Screen screen;
  RunWindow window(world, master, screen, {"--follow", "Pioneer1"});
  const cv::Mat before = screen.shot();
  panel.load(readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/opho2_1.xml"));
  window.waitForChange(before);
  EXPECT_TRUE(window.isOpen());
  EXPECT_GE(window.waitUntilLit(), 100'000) << "the window has not closed";
  EXPECT_EQ(window.quit().exit_code, 0);
}

TEST(View, ShowsARecordingWithAnEarlyFirstTimestamp) {
  const auto folder = emptyFolder();
  writeForeignRawlog(folder / "foreign.rawlog", std::chrono::hours(24 * 365 * 31));
  const Ended view =
      runProgram("view " + quoted(folder / "foreign.rawlog") + " --offscreen " + quoted(folder / "seen.png"));
  EXPECT_EQ(view.exit_code, 0) << view.err;
  EXPECT_TRUE(fs::exists(folder / "seen.png"));
}

TEST(View, ShowsARecordingOfAnotherProgram) {
  const auto folder = emptyFolder();
  writeForeignRawlog(folder / "foreign.rawlog");
  const auto picture_at = [&](double time_s) {
    const Ended view = runProgram("view " + quoted(folder / "foreign.rawlog") + " --size 600x600 --to " +
                                  std::to_string(time_s) + " --offscreen " + quoted(folder / "seen.png"));
    EXPECT_EQ(view.exit_code, 0) << view.err;
    return cv::imread((folder / "seen.png").string());
  };
  const cv::Mat start = picture_at(0), end = picture_at(9.8);
  const auto reds = [](const cv::Mat& picture) {  // pixels of the scan's tint and dots
    double x = 0;
    int count = 0;
    for (int row = 40; row < picture.rows; ++row) {
      for (int column = 0; column < picture.cols; ++column) {
        const auto& pixel = picture.at<cv::Vec3b>(row, column);
        if (pixel[2] < pixel[1] + 20) continue;
        x += column;
        ++count;
      }
    }
    EXPECT_GT(count, 3000);
    return x / count;
  };
  EXPECT_GT(reds(end), reds(start) + 50) << "the robot has taken its scan along";
}

TEST(View, Shows3dScansAndPathOfARecordingOfAnotherProgram) {
  const auto folder = emptyFolder();
  writeForeignRawlog(folder / "foreign.rawlog");
  const Ended view = runProgram("view " + quoted(folder / "foreign.rawlog") + " --3d --size 600x600 --offscreen " +
                                quoted(folder / "seen.png"));
  ASSERT_EQ(view.exit_code, 0) << view.err;
  const cv::Mat picture = cv::imread((folder / "seen.png").string());
  int reds = 0;
  cv::Rect seen;
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const auto& pixel = picture.at<cv::Vec3b>(row, column);
      if (pixel[2] < pixel[1] + 60) continue;
      ++reds;
      seen = seen.empty() ? cv::Rect(column, row, 1, 1) : seen | cv::Rect(column, row, 1, 1);
    }
  }
  EXPECT_GT(reds, 181 * 5) << "181 dots, the way, and the robot";
  EXPECT_GT(seen.width, 200) << "they fill the picture";
  EXPECT_GT(seen.height, 200);
}

TEST(View, RawLogViewerOpensARecording) {
  const auto folder = emptyFolder();
  ASSERT_EQ(runProgram("run worlds/opho2_1.xml --record " + quoted(folder / "run.rawlog")).exit_code, 0);
  const Screen screen;
  StartedProgram viewer = startStockWindow("RawLogViewer", folder / "run.rawlog");
  // Its time line has a blue dot for each observation.
  const int blue = screen.waitForPixels(2000, bluesIn, viewer);
  EXPECT_GE(blue, 2000) << viewer.error();
}

}  // namespace
}  // namespace robosim
