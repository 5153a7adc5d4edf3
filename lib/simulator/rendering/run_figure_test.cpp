#include "rendering/run_figure.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// 10 m × 5 m with a red robot that drove east, and a blue one that is not in the recording.
struct Drive {
  World world;
  Fleet fleet;
  DrawnRun run;

  Drive() {
    world.name = "hall";
    world.bounds = {0, 10, 0, 5};
    for (const char* name : {"Ann", "Bob"}) {
      FleetRobot robot;
      robot.info.name = name;
      robot.info.radius_m = 0.25;
      fleet.robots.push_back(robot);
    }
    fleet.robots[0].color = {1, 0, 0};
    fleet.robots[1].color = {0, 0, 1};
    run.paths = {{{1, 1}, {5, 1}, {9, 1}}, {}};
    run.world_from_robot = {mrpt::math::TPose2D(9, 1, 0), std::nullopt};
  }

  cv::Mat picture() const {
    const std::string png = runFigure(PictureFormat::png, world, fleet, run);
    return cv::imdecode(cv::Mat(1, static_cast<int>(png.size()), CV_8U, const_cast<char*>(png.data())),
                        cv::IMREAD_COLOR);
  }
  /// Pixel of a place; a picture has two pixels per pixel of the view.
  cv::Point pixelOf(const TPoint2D& place) const {
    const TPoint2D pixel = figureView(world, run).toPixel(place);
    return {static_cast<int>(std::floor(2 * pixel.x + 1)), static_cast<int>(std::floor(2 * pixel.y + 1))};
  }
};

/// Number of pixels near a place whose colour is within 40 of an expected one; near: within 10 pixels of the view.
int near(const Drive& drive, const cv::Mat& picture, const TPoint2D& place, const cv::Vec3b& bgr) {
  const cv::Point center = drive.pixelOf(place);
  cv::Mat found;
  cv::inRange(picture(cv::Rect(center - cv::Point(20, 20), cv::Size(41, 41)) & cv::Rect({}, picture.size())),
              cv::Scalar(bgr) - cv::Scalar::all(40), cv::Scalar(bgr) + cv::Scalar::all(40), found);
  return cv::countNonZero(found);
}

const cv::Vec3b kRed(0, 0, 255), kBlue(255, 0, 0), kGold(26, 204, 255), kStop(13, 13, 204), kInk(56, 46, 41);

TEST(RunFigure, IsAsWideAsAPageOfPaperWithTwicePixelsInAPng) {
  const Drive drive;
  const GroundView view = figureView(drive.world, drive.run);
  EXPECT_EQ(view.width(), 680);
  EXPECT_GT(view.pixelsPerMetre(), 60);  // 680 without margins for the axes, over 10 m
  EXPECT_LT(view.pixelsPerMetre(), 65);
  EXPECT_EQ(drive.picture().size(), cv::Size(1360, 2 * view.height()));
}

TEST(RunFigure, DrawsTrajectoriesAndRobotsInTheirColours) {
  const Drive drive;
  const cv::Mat picture = drive.picture();
  EXPECT_EQ(picture.at<cv::Vec3b>(drive.pixelOf({3, 1})), kRed);
  EXPECT_EQ(picture.at<cv::Vec3b>(drive.pixelOf({8.85, 1})), kRed) << "the robot";
  EXPECT_EQ(picture.at<cv::Vec3b>(drive.pixelOf({9.15, 1})), cv::Vec3b(255, 255, 255)) << "its heading";
  EXPECT_EQ(picture.at<cv::Vec3b>(drive.pixelOf({1, 1})), cv::Vec3b(255, 255, 255)) << "the ring at the start";
  cv::Mat blue;
  cv::inRange(picture, cv::Scalar(200, 0, 0), cv::Scalar(255, 60, 60), blue);
  EXPECT_EQ(cv::countNonZero(blue), 0) << "a robot without poses is not drawn";
}

TEST(RunFigure, HasTicksAtRoundLengths) {
  const Drive drive;
  const cv::Mat picture = drive.picture();
  // A pixel of the view is 1.6 cm: ticks, 5 pixels long, are 1 m apart, as the grid is.
  for (int metre = 0; metre <= 5; ++metre) {
    const cv::Point below = drive.pixelOf({static_cast<double>(metre), 0}) + cv::Point(0, 8);
    const cv::Point beside = drive.pixelOf({0, static_cast<double>(metre)}) - cv::Point(8, 0);
    EXPECT_LT(cv::norm(picture.at<cv::Vec3b>(below), kInk, cv::NORM_INF), 130) << metre;
    EXPECT_LT(cv::norm(picture.at<cv::Vec3b>(beside), kInk, cv::NORM_INF), 130) << metre;
    EXPECT_EQ(picture.at<cv::Vec3b>(below + cv::Point(20, 0)), cv::Vec3b(255, 255, 255)) << metre;
  }
}

TEST(RunFigure, MarksEventsAtTheirPositions) {
  Drive drive;
  const cv::Mat without = drive.picture();
  drive.run.events = {
      {RunEvent::Kind::gold, 0, {2, 4}}, {RunEvent::Kind::message, 0, {4, 4}}, {RunEvent::Kind::stall, 0, {6, 4}}};
  const cv::Mat picture = drive.picture();
  EXPECT_GT(near(drive, picture, {2, 4}, kGold), 100);
  EXPECT_GT(near(drive, picture, {4, 4}, {0, 0, 191}), 30) << "the robot's colour, darker";
  EXPECT_GT(near(drive, picture, {6, 4}, kStop), 20);
  // The legend lists only what there is.
  cv::Mat difference;
  cv::absdiff(picture.rowRange(picture.rows - 60, picture.rows), without.rowRange(without.rows - 60, without.rows),
              difference);
  EXPECT_GT(cv::norm(difference), 0);
}

TEST(RunFigure, MarksEventsOfAStandingRobotOnce) {
  Drive drive;
  drive.run.events = {{RunEvent::Kind::stall, 0, {2, 4}}};
  const cv::Mat once = drive.picture();
  for (int i = 0; i < 20; ++i) drive.run.events.push_back({RunEvent::Kind::stall, 0, {2 + 0.01 * i, 4}});
  EXPECT_EQ(cv::norm(once, drive.picture()), 0);
}

TEST(RunFigure, MovesAMarkOnARobotBesideIt) {
  Drive drive;
  drive.run.events = {{RunEvent::Kind::gold, 0, {9, 1}}};
  const cv::Mat picture = drive.picture();
  EXPECT_EQ(picture.at<cv::Vec3b>(drive.pixelOf({8.85, 1})), kRed) << "the robot is not covered";
  cv::Mat gold;
  const cv::Point robot = drive.pixelOf({9, 1});
  cv::inRange(picture(cv::Rect(robot - cv::Point(60, 60), cv::Size(120, 120))), cv::Scalar(kGold) - cv::Scalar::all(9),
              cv::Scalar(kGold) + cv::Scalar::all(9), gold);
  EXPECT_GT(cv::countNonZero(gold), 100);
}

TEST(RunFigure, HasEqualBytesForEqualRuns) {
  const Drive a, b;
  for (const auto format : {PictureFormat::png, PictureFormat::svg, PictureFormat::pdf}) {
    EXPECT_TRUE(runFigure(format, a.world, a.fleet, a.run) == runFigure(format, b.world, b.fleet, b.run));
  }
}

TEST(RunFigure, DrawsWorldsOfAnySize) {
  Drive drive;
  for (const Bounds2D& bounds : {Bounds2D{0, 0, 0, 0}, Bounds2D{0, 0.01, 0, 0.02}, Bounds2D{-1e6, 1e6, -1e6, 1e6}}) {
    drive.world.bounds = bounds;
    EXPECT_FALSE(drive.picture().empty()) << bounds.x_max;
  }
}

}  // namespace
}  // namespace robosim
