#include "replay/recording_figure.h"

#include <cmath>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/error_list.h"
#include "recording/robot_status_record.h"
#include "rendering/run_figure.h"
#include "robots/world_source.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

mrpt::obs::CObservationRobotPose truth(const std::string& robot, const TPose2D& pose) {
  mrpt::obs::CObservationRobotPose observation;
  observation.sensorLabel = robot + "/GROUND_TRUTH";
  observation.pose.mean = mrpt::poses::CPose3D(pose);
  return observation;
}

mrpt::obs::CObservationOdometry odometry(const std::string& label, const TPose2D& pose) {
  mrpt::obs::CObservationOdometry observation;
  observation.sensorLabel = label;
  observation.odometry = mrpt::poses::CPose2D(pose);
  return observation;
}

/// A square room of 8 m with two robots, red and blue; the second starts at (6, 6), facing north.
RunNote twoRobots() {
  RunNote note;
  note.world.file = "room.xml";
  note.world.robot_types = robotTypesIn(robotTypeFolders(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml"));
  note.world.text =
      "<world><surface><size><xmin>0</xmin><xmax>8</xmax><ymin>0</ymin><ymax>8</ymax></size>"
      "<object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>1</x><y>1</y><direction>0</direction>"
      "<color>1 0 0</color></robot></shape></object>"
      "<object><shape><robot><model>pioneer3dx</model><name>Bob</name><x>6</x><y>6</y><direction>1.5707963</direction>"
      "<color>0 0 1</color></robot></shape></object></surface></world>";
  return note;
}

const cv::Vec3b kRed(0, 0, 255), kBlue(255, 0, 0);

/// The picture of a figure of twoRobots().
class Picture {
 public:
  explicit Picture(const RecordingFigure& figure) : view_(figureView(loadWorld(twoRobots().world, {}).world, {})) {
    const std::string png = figure.draw(PictureFormat::png);
    pixels_ = cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_COLOR);
  }

  cv::Vec3b at(const TPoint2D& place) const { return pixels_.at<cv::Vec3b>(pixelOf(place)); }

  /// The number of pixels of a colour within 0.4 m of a place.
  int count(const TPoint2D& place, const cv::Scalar& bgr) const {
    const int half = static_cast<int>(0.4 * 2 * view_.pixelsPerMetre());
    cv::Mat found;
    cv::inRange(pixels_(cv::Rect(pixelOf(place) - cv::Point(half, half), cv::Size(2 * half, 2 * half))),
                bgr - cv::Scalar::all(15), bgr + cv::Scalar::all(15), found);
    return cv::countNonZero(found);
  }

 private:
  cv::Point pixelOf(const TPoint2D& place) const {
    const TPoint2D pixel = view_.toPixel(place);
    return {static_cast<int>(2 * pixel.x + 1), static_cast<int>(2 * pixel.y + 1)};
  }

  GroundView view_;
  cv::Mat pixels_;
};

TEST(RecordingFigure, DrawsTrajectoriesOnTheWorldOfTheRecording) {
  RecordingFigure figure("run.rawlog");
  figure.setRun(twoRobots());
  for (int i = 0; i <= 100; ++i) {
    figure.add(truth("Ann", {1 + 0.05 * i, 1, 0}), 0.1 * i);
    figure.add(odometry("Ann/odometry", {0.01 * i, 3, 0}), 0.1 * i);  // wrong, and not used
    figure.add(truth("Bob", {6, 6 - 0.05 * i, 0}), 0.1 * i);
  }
  const Picture picture(figure);
  EXPECT_EQ(picture.at({3, 1}), kRed);
  EXPECT_EQ(picture.at({6, 4}), kBlue);
  EXPECT_EQ(picture.count({1.5, 4}, {0, 0, 255}), 0) << "the odometry";
}

TEST(RecordingFigure, DrawsOdometryFromTheStartsWithoutGroundTruth) {
  RecordingFigure figure("run.rawlog");
  figure.setRun(twoRobots());
  for (int i = 0; i <= 30; ++i) figure.add(odometry("Bob/odometry", {0.05 * i, 0, 0}), 0.1 * i);
  EXPECT_EQ(Picture(figure).at({6, 6.5}), kBlue) << "it starts at (6, 6), facing north";
}

TEST(RecordingFigure, IgnoresTheMotionOfThePairThatContainsTheNote) {
  RecordingFigure figure("run_sf.rawlog");
  figure.add(odometry("odometry", {0, 0, 0}), 0);  // RawlogReader returns it before the comment
  figure.setRun(twoRobots());
  for (int i = 0; i <= 100; ++i) figure.add(truth("Bob", {6, 6 - 0.05 * i, 0}), 0.1 * i);
  const Picture picture(figure);
  EXPECT_EQ(picture.at({6, 4}), kBlue);
  EXPECT_EQ(picture.count({0.5, 0.5}, {0, 0, 255}) + picture.count({0.5, 0.5}, {255, 0, 0}), 0);
  EXPECT_EQ(picture.count({1, 1}, {0, 0, 255}), 0) << "Ann is not in the recording";
}

TEST(RecordingFigure, DrawsNoLineOverAnAbsenceOrAJump) {
  const RunNote note = twoRobots();
  RecordingFigure figure("run.rawlog");
  figure.setRun(note);
  const LoadedWorld loaded = loadWorld(note.world, {});
  RobotStatusRecord ann(loaded.fleet.robots[0].info);
  Readings readings;
  readings.measurements.resize(loaded.fleet.robots[0].info.sensors->size());
  Command absent;
  absent.activity = Activity::absent;
  figure.add(truth("Ann", {1, 1, 0}), 0);
  for (const auto& observation : ann.of(readings, absent)) figure.add(*observation, 0.1);
  figure.add(truth("Ann", {7, 1, 0}), 0.2);
  figure.add(truth("Bob", {1, 6, 0}), 0);
  figure.add(truth("Bob", {7, 6, 0}), 0.01);
  const Picture picture(figure);
  EXPECT_EQ(picture.count({4, 1}, {0, 0, 255}), 0) << "absent";
  EXPECT_EQ(picture.count({4, 6}, {255, 0, 0}), 0) << "jump";
  EXPECT_GT(picture.count({7, 1}, {0, 0, 255}), 50);
}

TEST(RecordingFigure, MarksEvents) {
  const RunNote note = twoRobots();
  const LoadedWorld loaded = loadWorld(note.world, {});
  RecordingFigure figure("run.rawlog");
  figure.setRun(note);
  RobotStatusRecord ann(loaded.fleet.robots[0].info), bob(loaded.fleet.robots[1].info);
  const auto step = [&](const TPose2D& pose_of_ann, Readings readings_of_ann, Readings readings_of_bob) {
    figure.add(truth("Ann", pose_of_ann), 0);
    figure.add(truth("Bob", {6, 6, 0}), 0);
    readings_of_ann.measurements.resize(loaded.fleet.robots[0].info.sensors->size());
    readings_of_bob.measurements.resize(loaded.fleet.robots[1].info.sensors->size());
    for (const auto& observation : ann.of(readings_of_ann, {})) figure.add(*observation, 0);
    for (const auto& observation : bob.of(readings_of_bob, {})) figure.add(*observation, 0);
  };
  Readings stalled, message, won;
  stalled.stalled = true;
  message.inbox.edit() = {{"Ann", "Bob", "hello"}};
  won.winner = "Ann";
  step({1, 1, 0}, {}, {});
  step({1, 3, 0}, stalled, {});
  step({1, 4.5, 0}, {}, message);
  step({4, 1, 0}, won, {});
  step({4, 4, 0}, won, {});
  const Picture picture(figure);
  EXPECT_GT(picture.count({1, 3}, {13, 13, 204}), 20) << "stall";
  EXPECT_EQ(picture.count({1, 2}, {13, 13, 204}), 0);
  EXPECT_GT(picture.count({1, 4.5}, {0, 0, 191}), 20) << "the message, where its sender was";
  EXPECT_GT(picture.count({4, 1}, {26, 204, 255}), 100) << "gold";
  EXPECT_EQ(picture.count({4, 4}, {26, 204, 255}), 0) << "was found before";
}

TEST(RecordingFigure, DrawsRobotsOfOtherProgramsWithoutAWorld) {
  RecordingFigure figure("foreign.rawlog");
  for (int i = 0; i <= 100; ++i) figure.add(odometry("ODOMETRY", {100 + 0.1 * i, 50, 0}), 0.1 * i);
  const std::string svg = figure.draw(PictureFormat::svg);
  EXPECT_NE(svg.find("<title>foreign, 10.0 s</title>"), std::string::npos);
  EXPECT_NE(svg.find("width=\"180mm\""), std::string::npos);
}

TEST(RecordingFigure, IgnoresPosesThatNoWorldHas) {
  RecordingFigure figure("run.rawlog");
  const double nan = std::nan("");
  figure.add(odometry("odometry", {nan, 0, 0}), 0);
  figure.add(odometry("odometry", {1e300, 0, 0}), 0);
  figure.add(odometry("odometry", {0, 0, nan}), 0);
  EXPECT_THROW(figure.draw(PictureFormat::png), ConfigError);
  figure.add(odometry("odometry", {1, 2, 0}), 0);
  EXPECT_FALSE(figure.draw(PictureFormat::png).empty());
}

TEST(RecordingFigure, RequiresPoses) {
  const RecordingFigure figure("empty.rawlog");
  try {
    figure.draw(PictureFormat::svg);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "empty.rawlog: contains neither ground truth nor odometry; a figure requires a recording with poses");
  }
}

}  // namespace
}  // namespace robosim
