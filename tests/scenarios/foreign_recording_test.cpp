// Recordings by other programs as shown in a view: unusual times and values, and robots and sensors that appear late.
#include "viewing/foreign_recording.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/system/datetime.h>

#include "tests/scenarios/program.h"

namespace robosim {
namespace {

/// Writes a rawlog, observation by observation.
class ForeignRawlog {
 public:
  ForeignRawlog() : file_(emptyFolder() / "foreign.rawlog"), stream_(file_.string()) {}

  static mrpt::Clock::time_point at(double time_s) {
    return mrpt::Clock::time_point(mrpt::Clock::duration(13'000'000'000'000'000 + std::llround(time_s * 1e7)));
  }

  void drive(const std::string& label, mrpt::Clock::time_point time, double x_m, double y_m = 0) {
    mrpt::obs::CObservationOdometry odometry;
    odometry.sensorLabel = label;
    odometry.timestamp = time;
    odometry.odometry = {x_m, y_m, 0};
    archive_ << odometry;
  }
  void stand(const std::string& label, mrpt::Clock::time_point time, double x_m) {
    mrpt::obs::CObservationRobotPose truth;
    truth.sensorLabel = label;
    truth.timestamp = time;
    truth.pose.mean = mrpt::poses::CPose3D(x_m, 0, 0, 0, 0, 0);
    archive_ << truth;
  }
  void scan(const std::string& label, mrpt::Clock::time_point time, std::size_t beams) {
    mrpt::obs::CObservation2DRangeScan scan;
    scan.sensorLabel = label;
    scan.timestamp = time;
    scan.aperture = static_cast<float>(M_PI);
    scan.maxRange = 80;
    scan.resizeScanAndAssign(beams, 4, true);
    archive_ << scan;
  }
  void act(mrpt::Clock::time_point time, double ahead_m) {
    mrpt::obs::CActionRobotMovement2D movement;
    movement.timestamp = time;
    movement.computeFromOdometry({ahead_m, 0, 0}, {});
    mrpt::obs::CActionCollection actions;
    actions.insert(movement);
    archive_ << actions;
  }
  /// A frame of two scans with these maximum ranges.
  void frame(mrpt::Clock::time_point time, float front_m, float back_m) {
    mrpt::obs::CSensoryFrame frame;
    for (const auto& [label, range_m] : {std::pair{"front", front_m}, {"back", back_m}}) {
      const auto scan = mrpt::obs::CObservation2DRangeScan::Create();
      scan->sensorLabel = label;
      scan->timestamp = time;
      scan->maxRange = 80;
      scan->resizeScanAndAssign(3, range_m, true);
      frame.insert(scan);
    }
    archive_ << frame;
  }
  struct Recording {
    LoadedWorld world;
    std::vector<RunSnapshot> moments;
    std::string read_error;
  };
  Recording read() {
    stream_.close();
    const auto recorded = readForeignRecording(file_.string());
    Recording recording{recorded->world(), {}, recorded->readError()};
    for (std::size_t i = 0; i < recorded->times().size(); ++i) {
      recording.moments.push_back(recorded->at(i));
      EXPECT_EQ(recording.moments.back().time_s, recorded->times()[i]);
    }
    for (std::size_t i = recording.moments.size(); i-- > 0;) expectSame(recorded->at(i), recording.moments[i]);
    return recording;
  }

 private:
  static void expectSame(const RunSnapshot& a, const RunSnapshot& b) {
    for (std::size_t i = 0; i < b.robots.size(); ++i) {
      EXPECT_EQ(a.robots.at(i).world_from_robot, b.robots[i].world_from_robot);
      ASSERT_EQ(a.robots[i].readings.has_value(), b.robots[i].readings.has_value());
      if (!b.robots[i].readings) continue;
      EXPECT_EQ(a.robots[i].readings->measurements, b.robots[i].readings->measurements);
    }
  }

  std::filesystem::path file_;
  mrpt::io::CFileGZOutputStream stream_;
  mrpt::serialization::CArchiveStreamBase<mrpt::io::CFileGZOutputStream> archive_{stream_};
};

std::vector<double> timesOf(const ForeignRawlog::Recording& recording) {
  std::vector<double> times;
  for (const auto& moment : recording.moments) times.push_back(moment.time_s);
  return times;
}

/// Readings of the first robot.
std::vector<double> pathOf(const ForeignRawlog::Recording& recording) {
  std::vector<double> way;
  for (const auto& moment : recording.moments) way.push_back(moment.robots.at(0).world_from_robot.x);
  return way;
}

const Echoes& echoesOf(const RunSnapshot& moment, std::size_t sensor) {
  return std::get<Echoes>(moment.robots.at(0).readings.value().measurements.at(sensor));
}

TEST(ForeignRecording, SortsMomentsByTimeFromTheEarliest) {
  ForeignRawlog rawlog;
  for (const double time_s : {0.5, 1.0, 0.0, 1.5}) rawlog.drive("odo", ForeignRawlog::at(time_s), 2 * time_s);
  const ForeignRawlog::Recording recording = rawlog.read();
  EXPECT_EQ(timesOf(recording), (std::vector{0.0, 0.5, 1.0, 1.5}));
  EXPECT_EQ(pathOf(recording), (std::vector{0.0, 1.0, 2.0, 3.0}));
  EXPECT_EQ(recording.moments.back().step, 3u);
}

TEST(ForeignRecording, ShowsGroundTruthInsteadOfOdometryOnceThereIsAny) {
  ForeignRawlog rawlog;
  rawlog.drive("odo", ForeignRawlog::at(0), 1);
  rawlog.stand("truth", ForeignRawlog::at(1), 10);
  rawlog.drive("odo", ForeignRawlog::at(2), 2);
  rawlog.stand("truth", ForeignRawlog::at(3), 11);
  const ForeignRawlog::Recording recording = rawlog.read();
  EXPECT_EQ(timesOf(recording), (std::vector{0.0, 1.0, 3.0}));
  EXPECT_EQ(pathOf(recording), (std::vector{1.0, 10.0, 11.0}));
}

TEST(ForeignRecording, AssignsThePreviousTimeToObservationsWithoutOne) {
  ForeignRawlog rawlog;
  rawlog.drive("odo", INVALID_TIMESTAMP, 1);
  rawlog.drive("odo", ForeignRawlog::at(2), 2);
  rawlog.drive("odo", INVALID_TIMESTAMP, 3);
  rawlog.drive("odo", ForeignRawlog::at(4), 4);
  const ForeignRawlog::Recording recording = rawlog.read();
  EXPECT_EQ(timesOf(recording), (std::vector{0.0, 0.1, 2.1})) << "a tenth of a second until there is a time";
  EXPECT_EQ(pathOf(recording), (std::vector{1.0, 3.0, 4.0}));
}

TEST(ForeignRecording, AdvancesByATenthOfASecondPerEntryWithoutTimestamps) {
  ForeignRawlog rawlog;
  for (const double x_m : {1, 2, 3}) rawlog.drive("odo", INVALID_TIMESTAMP, x_m);
  const ForeignRawlog::Recording recording = rawlog.read();
  ASSERT_EQ(recording.moments.size(), 3u);
  EXPECT_DOUBLE_EQ(recording.moments[2].time_s, 0.2);
  EXPECT_EQ(pathOf(recording), (std::vector{1.0, 2.0, 3.0}));
}

TEST(ForeignRecording, HandlesExtremeTimes) {
  using Time = mrpt::Clock::time_point;
  ForeignRawlog rawlog;
  rawlog.drive("odo", Time::max(), 2);
  rawlog.drive("odo", Time(mrpt::Clock::duration(1)), 1);
  const ForeignRawlog::Recording recording = rawlog.read();
  EXPECT_EQ(pathOf(recording), (std::vector{1.0, 2.0}));
  EXPECT_NEAR(recording.moments.back().time_s, 9.22e11, 1e10) << "2^63 times 100 ns";
}

TEST(ForeignRecording, KeepsASensorsLatestReading) {
  ForeignRawlog rawlog;
  rawlog.drive("odo", ForeignRawlog::at(0), 0);
  rawlog.scan("front", ForeignRawlog::at(0), 5);
  rawlog.scan("back", ForeignRawlog::at(1), 3);
  const ForeignRawlog::Recording recording = rawlog.read();
  ASSERT_EQ(recording.moments.size(), 2u);
  EXPECT_EQ(echoesOf(recording.moments[0], 0).size(), 5u);
  EXPECT_EQ(echoesOf(recording.moments[0], 1).size(), 0u) << "it has not measured yet";
  EXPECT_EQ(echoesOf(recording.moments[1], 1).size(), 3u);
}

TEST(ForeignRecording, RereadsEachObservationOfAFrame) {
  ForeignRawlog rawlog;
  for (int i = 0; i < 3; ++i) {
    const auto ahead_m = static_cast<float>(i);
    rawlog.act(ForeignRawlog::at(i), 0.5);
    rawlog.frame(ForeignRawlog::at(i), 10 + ahead_m, 20 + ahead_m);
  }
  const ForeignRawlog::Recording recording = rawlog.read();
  EXPECT_EQ(pathOf(recording), (std::vector{0.5, 1.0, 1.5}));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(echoesOf(recording.moments.at(i), 0).at(0).range_m, 10 + static_cast<float>(i));
    EXPECT_EQ(echoesOf(recording.moments.at(i), 1).at(0).range_m, 20 + static_cast<float>(i));
  }
}

TEST(ForeignRecording, HasABeamPerEchoOfScansOfVaryingSize) {
  ForeignRawlog rawlog;
  for (const std::size_t beams : {5, 0, 1, 3})
    rawlog.scan("laser", ForeignRawlog::at(static_cast<double>(beams)), beams);
  const ForeignRawlog::Recording recording = rawlog.read();
  const SensorInfo& laser = recording.world.fleet.robots.at(0).info.sensors->at(0);
  for (const auto& moment : recording.moments) EXPECT_LE(echoesOf(moment, 0).size(), laser.beams.size());
  EXPECT_EQ(echoesOf(recording.moments.back(), 0).size(), 5u);
}

TEST(ForeignRecording, DirectsAScanOfOneBeamAhead) {
  ForeignRawlog rawlog;
  rawlog.scan("laser", ForeignRawlog::at(0), 1);
  const ForeignRawlog::Recording recording = rawlog.read();
  EXPECT_EQ(recording.world.fleet.robots.at(0).info.sensors->at(0).beams.at(0).robot_from_beam.yaw, 0);
  EXPECT_EQ(echoesOf(recording.moments.at(0), 0).at(0).point_m, mrpt::math::TPoint3Df(4, 0, 0));
}

TEST(ForeignRecording, PlacesLateRobotsAtTheirFirstPoseWithoutReadings) {
  ForeignRawlog rawlog;
  rawlog.drive("Ann/odo", ForeignRawlog::at(0), 1);
  rawlog.drive("Bob/odo", ForeignRawlog::at(1), 7, 8);
  rawlog.drive("Bob/odo", ForeignRawlog::at(2), 9, 8);
  const ForeignRawlog::Recording recording = rawlog.read();
  ASSERT_EQ(recording.moments.size(), 3u);
  const RobotSnapshot& bob = recording.moments[0].robots.at(1);
  EXPECT_EQ(bob.world_from_robot, mrpt::math::TPose2D(7, 8, 0));
  EXPECT_FALSE(bob.readings);
  EXPECT_EQ(recording.moments[2].robots[1].world_from_robot.x, 9);
}

TEST(ForeignRecording, AssignsActionsToTheOnlyNamedRobot) {
  ForeignRawlog one;
  one.act(ForeignRawlog::at(0), 0.5);
  one.scan("Ann/laser", ForeignRawlog::at(0), 5);
  one.act(ForeignRawlog::at(1), 0.5);
  const ForeignRawlog::Recording recording = one.read();
  ASSERT_EQ(recording.world.fleet.robots.size(), 1u);
  EXPECT_EQ(recording.world.fleet.robots[0].info.name, "Ann");
  EXPECT_EQ(pathOf(recording), (std::vector{0.5, 1.0}));

  ForeignRawlog two;
  two.act(ForeignRawlog::at(0), 0.5);
  two.scan("Ann/laser", ForeignRawlog::at(0), 5);
  two.scan("Bob/laser", ForeignRawlog::at(0), 5);
  EXPECT_EQ(two.read().world.fleet.robots.size(), 3u)
      << "unlabelled observations with two named robots form a third robot";
}

TEST(ForeignRecording, OmitsAndReportsExtremePositions) {
  ForeignRawlog rawlog;
  rawlog.drive("odo", ForeignRawlog::at(0), 1);
  rawlog.drive("odo", ForeignRawlog::at(1), 1e300);
  rawlog.drive("odo", ForeignRawlog::at(2), std::numeric_limits<double>::quiet_NaN());
  rawlog.drive("odo", ForeignRawlog::at(3), 2);
  const ForeignRawlog::Recording recording = rawlog.read();
  EXPECT_EQ(pathOf(recording), (std::vector{1.0, 2.0}));
  EXPECT_EQ(recording.read_error, "2 observations have positions beyond 10,000 km or not finite; omitted");
}

}  // namespace
}  // namespace robosim
