#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "base/error_list.h"
#include "base/testing/test_folder.h"
#include "recording/rawlog_reader.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CObservationRobotPose;

/// "180 1 1 1 …", a count and as many equal ranges.
std::string ranges(std::size_t count, const std::string& range = "1") {
  std::string text = std::to_string(count);
  for (std::size_t i = 0; i < count; ++i) text += " " + range;
  return text;
}

constexpr const char* kNow = " 100.5 host 0.5\n";

class CarmenSourceTest : public TestFolder {
 protected:
  std::vector<CObservation::Ptr> all(const std::string& lines) {
    const auto file = in("a.log");
    std::ofstream(file, std::ios::binary) << "# CARMEN Logfile\n" << lines;
    RawlogReader reader(file);
    std::vector<CObservation::Ptr> observations;
    while (auto observation = reader.next()) observations.push_back(std::move(observation));
    unread_ = reader.unread();
    assumptions_ = reader.assumptions();
    error_ = reader.readError().value_or("");
    is_damaged_ = reader.isDamaged();
    ends_early_ = reader.endsEarly();
    EXPECT_TRUE(reader.isForeign());
    return observations;
  }
  /// The only scan, after the odometry of its line if there is one.
  std::shared_ptr<CObservation2DRangeScan> scanIn(const std::string& lines) {
    const auto observations = all(lines);
    return observations.empty() ? nullptr : std::dynamic_pointer_cast<CObservation2DRangeScan>(observations.back());
  }
  /// The first wrong line, without the file's name and what is done about it.
  std::string faultIn(const std::string& line) {
    all("ODOM 0 0 0 0 0 0" + std::string(kNow) + line + "\nSYNC end\n");
    const std::string at = in("a.log").string() + ":3: ";
    if (!error_.starts_with(at)) return error_;
    return error_.substr(at.size(), error_.find("; the line is left out") - at.size());
  }

  std::vector<std::string> unread_, assumptions_;
  std::string error_;
  bool is_damaged_ = false, ends_early_ = false;
};

double direction(const CObservation2DRangeScan& scan, std::size_t beam) {
  return scan.sensorPose.yaw() + static_cast<double>(scan.getScanAngle(beam));
}

TEST_F(CarmenSourceTest, ReadsOdometryWithItsTimeAndSpeeds) {
  const auto read = all("ODOM 1.5 -2 0.25 0.3 0.1 0 976052857.25 nohost 0.5\n");
  ASSERT_EQ(read.size(), 1u);
  const auto& odometry = dynamic_cast<const CObservationOdometry&>(*read[0]);
  EXPECT_EQ(odometry.sensorLabel, "robot/odometry");
  EXPECT_EQ(odometry.odometry, mrpt::poses::CPose2D(1.5, -2, 0.25));
  EXPECT_TRUE(odometry.hasVelocities);
  EXPECT_EQ(odometry.velocityLocal, mrpt::math::TTwist2D(0.3, 0, 0.1));
  EXPECT_DOUBLE_EQ(mrpt::Clock::toDouble(odometry.timestamp), 976052857.25);
}

TEST_F(CarmenSourceTest, GuessesTheAnglesOfOldScansByTheNumberOfReadingsAsCarmenDoes) {
  const struct {
    std::size_t count;
    double first_deg, last_deg;
  } cases[] = {{180, -90, 89}, {181, -90, 90}, {360, -90, 89.5}, {361, -90, 90}, {401, -50, 50}, {5, -90, 90}};
  for (const auto& [count, first_deg, last_deg] : cases) {
    const auto scan = scanIn("FLASER " + ranges(count) + " 0 0 0 0 0 0" + kNow);
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->getScanSize(), count);
    EXPECT_NEAR(direction(*scan, 0) * 180 / M_PI, first_deg, 1e-4) << count;
    EXPECT_NEAR(direction(*scan, count - 1) * 180 / M_PI, last_deg, 1e-4) << count;
    EXPECT_TRUE(scan->rightToLeft);
  }
}

TEST_F(CarmenSourceTest, ReadsAnOldScanAsOdometryAndScanOfOneTime) {
  const auto read = all("FLASER 3 1.25 81.9 0 1.1 2 0 1 2 0 100.5 host 0.5\n");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(dynamic_cast<const CObservationOdometry&>(*read[0]).odometry, mrpt::poses::CPose2D(1, 2, 0));
  const auto& scan = dynamic_cast<const CObservation2DRangeScan&>(*read[1]);
  EXPECT_EQ(scan.sensorLabel, "robot/laser");
  EXPECT_EQ(scan.timestamp, read[0]->timestamp);
  EXPECT_FLOAT_EQ(scan.maxRange, 80);
  EXPECT_FLOAT_EQ(scan.getScanRange(0), 1.25F);
  EXPECT_TRUE(scan.getScanRangeValidity(0));
  EXPECT_FALSE(scan.getScanRangeValidity(1)) << "81.9 m is no echo";
  EXPECT_FALSE(scan.getScanRangeValidity(2)) << "0 is none, too";
  EXPECT_NEAR(scan.sensorPose.x(), 0.1, 1e-9) << "by the two poses of the line";
  ASSERT_EQ(assumptions_.size(), 1u);
  EXPECT_EQ(
      assumptions_[0],
      "robot/laser: the log has no parameter with its place on the robot; it is taken by the poses of its first line");
}

TEST_F(CarmenSourceTest, TakesThePlaceOfOldScannersFromParameters) {
  const auto front =
      scanIn("PARAM robot_frontlaser_offset 0.17 0.1 host 0.1\nFLASER 3 1 1 1 5 5 1 0 0 0" + std::string(kNow));
  EXPECT_EQ(front->sensorPose, mrpt::poses::CPose3D(0.17, 0, 0, 0, 0, 0));
  EXPECT_TRUE(assumptions_.empty());
  const auto rear = scanIn("PARAM robot_rearlaser_offset -0.2\nRLASER 3 1 1 1 5 5 1 0 0 0" + std::string(kNow));
  EXPECT_EQ(rear->sensorLabel, "robot/laser_rear");
  EXPECT_NEAR(rear->sensorPose.x(), -0.2, 1e-9);
  EXPECT_NEAR(std::abs(rear->sensorPose.yaw()), M_PI, 1e-6) << "it looks backwards";
  const auto corrected = scanIn("FLASER 3 1 1 1 50 5 1 0 0 0" + std::string(kNow));
  EXPECT_EQ(corrected->sensorPose, mrpt::poses::CPose3D()) << "50 m away is where SLAM has put it";
  EXPECT_TRUE(assumptions_.at(0).ends_with("; it is taken at the origin"));
}

TEST_F(CarmenSourceTest, ReadsNewScansWithTheirAnglesPlaceAndMaximum) {
  // 3 beams from -45° with 45° between; the robot at (1, 2) looks along y, the scanner is 0.1 m ahead of it.
  const std::string head = "ROBOTLASER1 0 -0.785398163 1.57079633 0.785398163 30 0.01 0 3 1 2 30 ";
  const std::string poses = "1 2.1 1.57079633 1 2 1.57079633 0.3 0.1 0.5 0.4 ";
  for (const std::string& line : {head + "0 " + poses + "1e6 100.5 host 0.5\n",        // as CARMEN writes it
                                  head + "3 7 8 9 " + poses + "1e6 100.5 host 0.5\n",  // with remissions
                                  head + poses + "100.5 host 0.5\n"}) {                // before there were any
    const auto read = all(line);
    ASSERT_EQ(read.size(), 2u) << error_;
    EXPECT_NEAR(dynamic_cast<const CObservationOdometry&>(*read[0]).odometry.y(), 2, 1e-9);
    const auto& scan = dynamic_cast<const CObservation2DRangeScan&>(*read[1]);
    EXPECT_NEAR(direction(scan, 0), -M_PI / 4, 1e-6);
    EXPECT_NEAR(direction(scan, 2), M_PI / 4, 1e-6);
    EXPECT_NEAR(scan.sensorPose.x(), 0.1, 1e-6);
    EXPECT_NEAR(scan.sensorPose.y(), 0, 1e-6);
    EXPECT_FLOAT_EQ(scan.maxRange, 30);
    EXPECT_TRUE(scan.getScanRangeValidity(1));
    EXPECT_FALSE(scan.getScanRangeValidity(2));
    EXPECT_DOUBLE_EQ(mrpt::Clock::toDouble(scan.timestamp), 100.5);
  }
  const auto raw = scanIn("RAWLASER3 0 -1 2 1 30 0.01 0 3 1 2 3 0 100.5 host 0.5\n");
  EXPECT_EQ(raw->sensorLabel, "robot/laser_3");
  EXPECT_EQ(all("ROBOTLASER2 0 0 0 0 30 0 0 0 0 1 1 0 1 1 0 0 0 0 0 0 1 h 1\n").size(), 1u) << "odometry only";
}

TEST_F(CarmenSourceTest, HasTheOdometryOfScansOnlyWithoutLinesOfOdometry) {
  const std::string scan = "FLASER 2 1 1 0 0 0 1 0 0 1 h 1\n", odometry = "ODOM 2 0 0 0 0 0 2 h 2\n";
  EXPECT_EQ(all(scan + scan).size(), 4u);
  EXPECT_EQ(all(odometry + scan).size(), 2u);
  EXPECT_EQ(all(scan + odometry + scan).size(), 4u) << "up to the first line of odometry";
}

TEST_F(CarmenSourceTest, ReadsTruePosesAndListsWhatItDoesNotRead) {
  const auto read =
      all("SYNC start 1 h 1\nTRUEPOS 3 4 0.5 1 1 0" + std::string(kNow) + "NMEAGGA 1 2 3\nNMEAGGA 1 2 3\n");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0]->sensorLabel, "robot/GROUND_TRUTH");
  EXPECT_EQ(dynamic_cast<const CObservationRobotPose&>(*read[0]).pose.mean, mrpt::poses::CPose3D(3, 4, 0, 0.5, 0, 0));
  EXPECT_EQ(unread_, std::vector<std::string>{"NMEAGGA, 2 lines"});
  EXPECT_EQ(error_, "");
}

TEST_F(CarmenSourceTest, NamesTheFileAndLineOfWrongLinesAndLeavesThemOut) {
  EXPECT_EQ(faultIn("FLASER 180 1 2 3"), "FLASER: announces 180 readings, but 3 numbers follow");
  EXPECT_TRUE(is_damaged_);
  EXPECT_EQ(faultIn("FLASER 2 1 x 0 0 0 0 0 0 1 h 1"), "FLASER: 'x' is no number, in its readings");
  EXPECT_EQ(faultIn("FLASER -2"), "FLASER: has a wrong number of readings");
  EXPECT_EQ(faultIn("FLASER 2 1 1 0 0 0 0 0"), "FLASER: ends before the odometry");
  EXPECT_EQ(faultIn("ODOM 1 2 nan 0 0 0"), "ODOM: 'nan' is no number, for the odometry");
  EXPECT_EQ(faultIn("ODOM 1 2 3 0 0 0 1e300 h 1"), "ODOM: has a time that is no number of seconds since 1970");
  EXPECT_EQ(faultIn("ODOM 1 2 3 0 0 0 1 h 1 5 6"), "ODOM: has 2 words too many");
  EXPECT_EQ(faultIn("ROBOTLASER1 0 0 0 0 0 0 0 0 0"), "ROBOTLASER1: has no maximum range above 0");
  EXPECT_EQ(faultIn("hello there"), "is no message of CARMEN, which begins with a name in capitals");
  EXPECT_EQ(all("ODOM 0 0 0 0 0 0\nODOM 1\nODOM 1\nODOM 1 0 0 0 0 0\n").size(), 2u);
  EXPECT_TRUE(error_.ends_with(":3: ODOM: ends before the odometry; this line and 1 other is left out")) << error_;
}

TEST_F(CarmenSourceTest, TakesALastLineWithoutItsEndForCutOff) {
  EXPECT_EQ(all("ODOM 0 0 0 0 0 0\nFLASER 180 1 1 1 1").size(), 1u);
  EXPECT_TRUE(ends_early_);
  EXPECT_FALSE(is_damaged_);
  EXPECT_EQ(all("ODOM 0 0 0 0 0 0\nODOM 1 0 0 0 0 0").size(), 2u) << "a complete one needs no end";
  EXPECT_FALSE(ends_early_);
  EXPECT_THROW(all("SYNC start\n"), ConfigError);
}

TEST_F(CarmenSourceTest, ReadsLinesAgainAtTheirPositions) {
  const auto file = in("b.clf");
  std::ofstream(file)
      << "# CARMEN Logfile\nFLASER 2 1 1 0 0 0 1 0 0 1 h 1\nODOM 2 0 0 0 0 0 2 h 2\nFLASER 2 1 1 0 0 0 3 0 0 3 h 3\n";
  RawlogReader reader(file, RawlogReader::Access::random);
  std::vector<std::pair<std::uint64_t, CObservation::Ptr>> read;
  while (const auto observation = reader.next()) read.emplace_back(reader.position(), observation);
  ASSERT_EQ(read.size(), 4u);
  for (const std::size_t i : {2u, 0u, 3u}) {
    reader.seek(read[i].first);
    const auto again = reader.next();
    EXPECT_EQ(again->sensorLabel, read[i].second->sensorLabel);
    EXPECT_EQ(again->timestamp, read[i].second->timestamp);
  }
  EXPECT_EQ(reader.entries(), 3u);
}

}  // namespace
}  // namespace robosim
