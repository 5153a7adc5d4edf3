// Windows of `robosim view` under Xvfb: keys, the bar and its slider.
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/temporary_directory.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/screen.h"
#include "tests/scenarios/verifying.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

bool areSame(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

/// 10 m × 10 m: blue boxes of 2 m × 2 m on the upper and the lower edge, and a robot in the middle.
fs::path writeHallOfTwoBoxes(const fs::path& folder) {
  std::ofstream out(folder / "hall.xml");
  out << "<world><surface><size><xmin>0</xmin><xmax>10</xmax><ymin>0</ymin><ymax>10</ymax></size>";
  for (const int y : {1, 9}) {
    out << "<object><shape><primitive><cube><name>Box" << y << "</name><x>8</x><y>" << y << "</y><z>0.5</z>"
        << "<length>2</length><width>2</width><height>1</height><color>0 0 "
           "1</color></cube></primitive></shape></object>";
  }
  out << R"(<object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>5</x><y>5</y><color>1 0 0</color>
    <controller>wander</controller></robot></shape></object></surface></world>)";
  return folder / "hall.xml";
}

/// Runs the hall.
fs::path recordHall(const fs::path& folder, const std::string& seconds) {
  const auto rawlog = folder / "run.rawlog";
  const Ended run =
      runProgram("run " + quoted(writeHallOfTwoBoxes(folder)) + " --time " + seconds + " --record " + quoted(rawlog));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return rawlog;
}

/// The hall, run for 20 s; recorded once for all tests.
const fs::path& recordedHall() {
  static const TemporaryDirectory folder;
  static const fs::path rawlog = recordHall(folder.path(), "20");
  return rawlog;
}

/// The part of a 900 × 700 window above its bar.
cv::Mat picturePart(const cv::Mat& screen) { return screen(cv::Rect(0, 0, 900, 600)).clone(); }

/// A window of `robosim view`, after its first drawing.
class Window {
 public:
  explicit Window(const std::vector<std::string>& arguments) : view_(arguments) {
    screen_.waitForPixels(2000, bluesIn, view_);
    start_ = last_ = settled({});
  }

  /// The first picture.
  const cv::Mat& start() const { return start_; }
  /// The picture after it has changed as a result of keys or other `xdotool` actions.
  cv::Mat after(const std::string& keys) { return afterDoing(Screen::keys(keys)); }
  cv::Mat afterDoing(const std::string& what) {
    const cv::Mat before = last_;
    const auto begin = Clock::now();
    screen_.act(what);
    const cv::Mat seen = screen_.waitFor([&](const cv::Mat& each) { return !areSame(each, before); }, view_);
    if (!areSame(seen, before)) return last_ = settled(Clock::now() - begin);
    ADD_FAILURE() << what << " changes nothing; " << view_.error();
    return before;
  }
  /// Whether the part above the bar becomes equal to this picture.
  bool comesToShow(const cv::Mat& expected, const std::string& what) {
    const auto begin = Clock::now();
    screen_.act(what);
    last_ = screen_.waitFor([&](const cv::Mat& seen) { return areSame(picturePart(seen), expected); }, view_);
    const bool shows = areSame(picturePart(last_), expected);
    if (shows) last_ = settled(Clock::now() - begin);
    return shows;
  }
  /// Result of the program after these actions.
  Ended endAfter(const std::string& what) {
    screen_.act(what);
    return view_.wait();
  }
  Ended interrupt() {
    view_.interrupt();
    return view_.wait();
  }
  void waitForError(const std::string& text) { view_.waitForError(text); }
  std::string error() const { return view_.error(); }
  int quit() {
    screen_.act(Screen::keys("q"));
    return view_.wait().exit_code;
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// The picture when it has stopped changing, for as long as a window takes for several repaints.
  /// @param reaction in which the picture first changed: longer on a slow machine
  cv::Mat settled(Clock::duration reaction) {
    const auto unchanged = std::max<Clock::duration>(std::chrono::milliseconds(150), reaction);
    cv::Mat last = screen_.shot();
    Clock::time_point since = Clock::now();
    screen_.waitFor(
        [&](const cv::Mat& seen) {
          if (!areSame(seen, last)) since = Clock::now();
          last = seen;
          return Clock::now() - since > unchanged;
        },
        view_);
    return last;
  }

  Screen screen_;
  StartedProgram view_;
  cv::Mat start_, last_;
};

/// So slow that nothing moves during a test: 100 s per step.
const std::vector<std::string> kHardlyMoving{"--speed", "0.001", "--size", "900x700"};

std::vector<std::string> viewOf(const fs::path& file, const std::vector<std::string>& more = kHardlyMoving) {
  std::vector<std::string> words{"view", file.string()};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(ViewWindow, SeeksInARecordingWithKeys) {
  Window window(viewOf(recordedHall()));
  const cv::Mat paused = window.after("space");
  // Edges differ slightly in the first picture, which is drawn in another way than later ones (TopView::draw()).
  const cv::Mat going = window.after("space");
  EXPECT_TRUE(areSame(window.after("space"), paused));
  const cv::Mat at_5_s = window.after("Right");
  EXPECT_FALSE(areSame(at_5_s, paused));
  EXPECT_TRUE(areSame(window.after("Left"), paused));
  const cv::Mat first_step = window.after("s");
  EXPECT_FALSE(areSame(first_step, at_5_s));
  EXPECT_TRUE(areSame(window.after("Left"), paused)) << "no farther back than the beginning";
  EXPECT_TRUE(areSame(window.after("space"), going)) << "continues from the beginning";
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, SeeksInARecordingWithTheSlider) {
  Window window(viewOf(recordedHall()));
  // Without paths, a picture does not depend on how its time was reached.
  window.after("Right");
  window.after("t");
  const cv::Mat begin = picturePart(window.after("Left"));
  window.after("Right Right");
  const cv::Mat at_15_s = picturePart(window.after("Right"));
  const cv::Mat end = picturePart(window.after("Right"));
  EXPECT_FALSE(areSame(begin, end));
  // The slider has the width of the window. Dragging beyond its end sets it to its end.
  const std::string press = "windowfocus mousemove --window %1 450 686 mousedown 1 ";
  EXPECT_TRUE(window.comesToShow(begin, press + "mousemove --window %1 5 686 mouseup 1"));
  EXPECT_TRUE(window.comesToShow(end, press + "mousemove --window %1 895 686 mouseup 1"));
  const cv::Mat middle =
      picturePart(window.afterDoing("windowfocus mousemove --window %1 450 686 mousedown 1 mouseup 1"));
  for (const cv::Mat& other : {begin, at_15_s, end}) EXPECT_FALSE(areSame(middle, other));
  EXPECT_TRUE(window.comesToShow(end, Screen::keys("Right Right Right"))) << "from 5 s on, or later";
  window.afterDoing("windowfocus mousemove --window %1 450 686 mousedown 1 mouseup 1");
  EXPECT_TRUE(window.comesToShow(begin, Screen::keys("Left Left Left"))) << "from 15 s on, or sooner";
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, ClosesWithAnErrorWhenReadingFails) {
  const auto folder = emptyFolder();
  const auto rawlog = recordHall(folder, "300");
  Window window(viewOf(rawlog, {"--speed", "0.001", "--size", "900x700", "--from", "299"}));
  // The file is truncated, and then its beginning is shown.
  fs::resize_file(rawlog, 0);
  const Ended ended = window.endAfter("windowfocus mousemove --window %1 450 686 mousedown 1 mouseup 1");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(withoutDesktopMessages(ended.err),
            "robosim view: " + rawlog.string() + ": has changed since it was opened; open it again\n");
}

TEST(ViewWindow, ClosesOnCtrlCWithoutOtherEvents) {
  // The failure was intermittent.
  for (int i = 0; i < (isVerifying() ? 10 : 2); ++i) {
    const Ended ended = Window(viewOf(recordedHall())).interrupt();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  }
}

TEST(ViewWindow, FollowsARobotAndShowsEverythingAgain) {
  Window window(viewOf(recordedHall()));
  const cv::Mat riding = window.after("f");
  EXPECT_LT(bluesIn(riding), bluesIn(window.start())) << "the boxes are beyond 3 m";
  EXPECT_TRUE(areSame(window.after("0"), window.start()));
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, HidesAndShowsPathsSensorsAndNames) {
  Window window(viewOf(recordedHall()));
  const cv::Mat all = window.after("Right");
  std::vector<cv::Mat> less;
  for (const char* key : {"t", "v", "n"}) {
    less.push_back(window.after(key));
    EXPECT_TRUE(areSame(window.after(key), all)) << key;
  }
  EXPECT_FALSE(areSame(less[0], less[1]));
  EXPECT_FALSE(areSame(less[1], less[2]));
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, ShowsTheSpeedChangedWithKeys) {
  Window window(viewOf(recordedHall()));
  const cv::Mat slowest = window.after("space plus");  // 0.01, the minimum, and paused
  const cv::Mat faster = window.after("plus");
  EXPECT_FALSE(areSame(faster, slowest));
  EXPECT_TRUE(areSame(window.after("minus"), slowest));
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, PlacesTheBarBelowThePicture) {
  Window window(viewOf(recordedHall()));
  const int above = bluesIn(window.start()(cv::Rect(0, 0, 1024, 350)));
  const int below = bluesIn(window.start()(cv::Rect(0, 350, 1024, 350)));
  EXPECT_GT(above, 5000);
  EXPECT_NEAR(below, above, 300) << "the box on the lower edge is as large as that on the upper";
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, PrintsWhyARecordingEndsEarly) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.rawlog";
  fs::copy_file(recordedHall(), rawlog);
  fs::resize_file(rawlog, fs::file_size(rawlog) / 2);
  Window window(viewOf(rawlog));
  const std::string remark = "robosim view: " + rawlog.string() + ": ends early";
  window.waitForError(remark);
  EXPECT_EQ(countOf(remark, window.error()), 1u) << window.error();
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, Shows3dViewsLikePictureFiles) {
  const auto folder = emptyFolder();
  const auto hall = writeHallOfTwoBoxes(folder);
  Window window(viewOf(hall, {"--3d", "--size", "1000x536"}));  // 500 px above the toolbar
  const auto file = folder / "air.png";
  ASSERT_EQ(
      runProgram("view '" + hall.string() + "' --3d --size 1000x500 --offscreen '" + file.string() + "'").exit_code, 0);
  const cv::Mat picture = cv::imread(file.string());
  const cv::Mat seen = window.start()(cv::Rect(0, 0, 1000, 500));
  EXPECT_GT(bluesIn(picture), 2000);
  EXPECT_LT(cv::norm(seen, picture, cv::NORM_L1) / static_cast<double>(3 * picture.total()), 1);
  const cv::Mat turned =
      window.afterDoing("windowfocus mousemove --window %1 300 250 mousedown 1 mousemove_relative 90 0 mouseup 1");
  EXPECT_GT(bluesIn(turned), 1000);
  EXPECT_TRUE(areSame(window.after("0"), window.start()));
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, ShowsThePathOfAnyTimeHoweverItWasReached) {
  Window window(viewOf(recordedHall()));
  window.after("space");
  const cv::Mat at_5_s = picturePart(window.after("Right"));
  window.after("Right Right");
  EXPECT_TRUE(areSame(picturePart(window.after("Left Left")), at_5_s)) << "after seeking back";
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, ShowsHelpOnAQuestionMark) {
  Window window(viewOf(recordedHall()));
  const cv::Mat before = window.after("space");
  const cv::Mat help = window.afterDoing("windowfocus key --window 0 question");
  EXPECT_GT(cv::norm(help, before, cv::NORM_L1) / static_cast<double>(before.total()), 20) << "a large panel";
  EXPECT_TRUE(areSame(window.after("Escape"), before)) << "closes the help, not the window";
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, FillsTheScreenOnF11) {
  Window window(viewOf(recordedHall()));
  const auto is_black = [](const cv::Mat& picture) { return picture.at<cv::Vec3b>(760, 1015) == cv::Vec3b(0, 0, 0); };
  ASSERT_TRUE(is_black(window.start())) << "the screen of 1024 x 768 beside the window";
  EXPECT_FALSE(is_black(window.after("F11")));
  EXPECT_TRUE(is_black(window.after("F11")));
  EXPECT_EQ(window.quit(), 0);
}

TEST(ViewWindow, ScalesTextAndLines) {
  const auto folder = emptyFolder();
  const auto hall = writeHallOfTwoBoxes(folder);
  const auto draw = [&](const std::string& name, const std::string& how) {
    const auto file = folder / name;
    const Ended ended = runProgram("view '" + hall.string() + "' --offscreen '" + file.string() + "' " + how);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return cv::imread(file.string());
  };
  const cv::Mat small = draw("small.png", "--size 500x400"), large = draw("large.png", "--size 1000x800 --scale 2");
  ASSERT_EQ(large.size(), cv::Size(1000, 800));
  cv::Mat reduced;
  cv::resize(large, reduced, small.size(), 0, 0, cv::INTER_AREA);
  EXPECT_LT(cv::norm(reduced, small, cv::NORM_L1) / static_cast<double>(3 * small.total()), 3) << "the same, larger";
}

}  // namespace
}  // namespace robosim
