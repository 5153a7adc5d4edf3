// MRPT programs read the recordings.
#include "tests/stock_tools.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <regex>
#include <vector>

#include <gtest/gtest.h>

#include "base/testing/test_folder.h"
#include "recording/rawlog_writer.h"
#include "recording/testing/sample_robot.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

using StockTools = TestFolder;

// A robot drives once round an ellipse in a room of 8 m × 6 m with a corner cut off and a pillar.

struct Wall {
  TPoint2D from, to;
};

const std::vector<Wall> kRoom{{{-4, -3}, {4, -3}},       {{4, -3}, {4, 1}},         {{4, 1}, {2.8, 3}},
                              {{2.8, 3}, {-4, 3}},       {{-4, 3}, {-4, -3}},       {{-0.5, -0.2}, {0.3, -0.2}},
                              {{0.3, -0.2}, {0.3, 0.4}}, {{0.3, 0.4}, {-0.5, 0.4}}, {{-0.5, 0.4}, {-0.5, -0.2}}};

double rangeTo(const Wall& wall, const TPoint2D& origin, double angle_rad) {
  // origin + t * out = from + u * along
  const TPoint2D out(std::cos(angle_rad), std::sin(angle_rad));
  const TPoint2D along = wall.to - wall.from;
  const TPoint2D off = wall.from - origin;
  const double det = along.x * out.y - along.y * out.x;
  const double t = (along.x * off.y - along.y * off.x) / det;
  const double u = (out.x * off.y - out.y * off.x) / det;
  return det != 0 && t > 0 && u >= 0 && u <= 1 ? t : std::numeric_limits<double>::infinity();
}

Echoes scanOf(const SensorInfo& scanner, const TPose2D& world_from_robot) {
  Echoes echoes;
  for (const auto& beam : scanner.beams) {
    const auto& at = beam.robot_from_beam;
    const TPose2D world_from_beam = world_from_robot + TPose2D(at.x, at.y, at.yaw);
    double range_m = scanner.no_echo_m;
    for (const auto& wall : kRoom) {
      range_m = std::min(range_m, rangeTo(wall, {world_from_beam.x, world_from_beam.y}, world_from_beam.phi));
    }
    echoes.push_back({static_cast<float>(range_m), {}});
  }
  return echoes;
}

constexpr int kSteps = 450;

TPose2D truePose(int step) {
  const double t = 2 * M_PI * step / kSteps;
  return {2.4 * std::cos(t), 1.8 * std::sin(t), std::atan2(1.8 * std::cos(t), -2.4 * std::sin(t))};
}

/// A scanner, and wheel odometry with 5 % too large distances and angles.
RobotInfo scanningRobot() {
  RobotInfo robot;
  robot.name = "rover";
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(
      std::vector<SensorInfo>{sampleScanner(6), plainSensor(SensorKind::odometry, "odometry")});
  return robot;
}

/// @returns RMS error [m] of the odometry's path, laid at the true start.
double recordEllipse(const fs::path& file, RawlogFormat format) {
  const RobotInfo robot = scanningRobot();
  RawlogWriter writer(file, std::span(&robot, 1), format, RawlogImages::embedded, "a note at the beginning");
  TPose2D odom_from_robot;
  double sum_m2 = 0;
  for (int step = 0; step < kSteps; ++step) {
    const TPose2D world_from_robot = truePose(step);
    Odometry odometry;
    if (step > 0) {
      const TPose2D move = world_from_robot - truePose(step - 1);
      odom_from_robot = odom_from_robot + TPose2D(1.05 * move.x, 1.05 * move.y, 1.05 * move.phi);
      odometry = {odom_from_robot, 1.05 * move.x / 0.1, 1.05 * move.phi / 0.1};
    }
    Readings readings;
    readings.time = {static_cast<std::uint64_t>(step), 0.1};
    readings.measurements = {scanOf((*robot.sensors)[0], world_from_robot), odometry};
    writer.write(std::span(&readings, 1), std::span(&world_from_robot, 1));
    const TPose2D estimated = truePose(0) + odom_from_robot;
    sum_m2 += std::pow(estimated.x - world_from_robot.x, 2) + std::pow(estimated.y - world_from_robot.y, 2);
  }
  writer.close("a note at the end");
  return std::sqrt(sum_m2 / kSteps);
}

void recordSamples(const fs::path& file, RawlogFormat format, int steps) {
  const RobotInfo robot = sampleRobot("rover");
  RawlogWriter writer(file, std::span(&robot, 1), format);
  for (int step = 0; step < steps; ++step) {
    const auto readings = sampleReadings(robot, static_cast<std::uint64_t>(step));
    const TPose2D truth(0.1 * step, 2, 0);
    writer.write(std::span(&readings, 1), std::span(&truth, 1));
  }
  writer.close();
}

std::vector<std::string> linesOf(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST_F(StockTools, RawlogEditCountsTheObservationsOfEverySensor) {
  recordSamples(in("run.rawlog"), RawlogFormat::observations, 30);
  const ToolRun info = runTool("rawlog-edit -i run.rawlog --info", folder_);
  EXPECT_EQ(info.exit_code, 0) << info.output;
  // MRPT 2.14 puts spaces before the rate and the duration.
  const std::regex occurrences("rover/GROUND_TRUTH / +30 / ?10\\.000 / ?2\\.900");
  EXPECT_TRUE(std::regex_search(info.output, occurrences)) << info.output;
  for (const char* expected :
       {"Overall number of objects         : 360", "Observations format               : Yes",
        "Earliest timestamp                : 1104537600.000000 (2005/01/01,00:00:00.000000 UTC)",
        "Latest timestamp                  : 1104537602.900000", "rover/GROUND_TRUTH", "rover/sonar", "rover/laser",
        "rover/beam", "rover/infrared", "rover/heat", "rover/bumper", "rover/odometry", "rover/compass",
        "rover/battery", "rover/beacons", "rover/air"}) {
    EXPECT_NE(info.output.find(expected), std::string::npos) << expected << " in\n" << info.output;
  }
}

TEST_F(StockTools, RawlogEditCountsActionsAndSensoryFrames) {
  recordSamples(in("run.rawlog"), RawlogFormat::sensory_frames, 30);
  const ToolRun info = runTool("rawlog-edit -i run.rawlog --info", folder_);
  EXPECT_EQ(info.exit_code, 0) << info.output;
  for (const char* expected : {"Overall number of objects         : 60", "Actions/SensoryFrame format       : Yes"}) {
    EXPECT_NE(info.output.find(expected), std::string::npos) << expected << " in\n" << info.output;
  }
}

TEST_F(StockTools, RawlogEditExportsTheGroundTruthAsText) {
  recordSamples(in("run.rawlog"), RawlogFormat::observations, 30);
  const ToolRun exported = runTool("rawlog-edit -i run.rawlog --export-txt", folder_);
  EXPECT_EQ(exported.exit_code, 0) << exported.output;
  const auto lines = linesOf(folder_ / "run_rover_GROUND_TRUTH.txt");
  ASSERT_EQ(lines.size(), 31u);  // a header, and a line a step
  double time_s = 0, x_m = 0, y_m = 0;
  std::istringstream(lines.back()) >> time_s >> x_m >> y_m;
  EXPECT_NEAR(time_s, 1104537602.9, 1e-6);
  EXPECT_NEAR(x_m, 2.9, 1e-5);
  EXPECT_NEAR(y_m, 2, 1e-5);
}

TEST_F(StockTools, RawlogEditExportsHeatAsATemperature) {
  recordSamples(in("run.rawlog"), RawlogFormat::observations, 30);
  const ToolRun exported = runTool("rawlog-edit -i run.rawlog --export-enose-txt", folder_);
  EXPECT_EQ(exported.exit_code, 0) << exported.output;
  const auto lines = linesOf(folder_ / "run_rover_heat.txt");
  ASSERT_EQ(lines.size(), 31u);
  double time_s = 0, heat_celsius = 0;
  std::istringstream(lines.back()) >> time_s >> heat_celsius;
  const auto readings = sampleReadings(sampleRobot("rover"), 29);
  EXPECT_NEAR(heat_celsius, std::get<Scalar>(readings.measurements[4]).value, 1e-4);
}

TEST_F(StockTools, RawlogEditCountsAndDescribesBeacons) {
  recordSamples(in("run.rawlog"), RawlogFormat::observations, 30);
  const ToolRun info = runTool("rawlog-edit -i run.rawlog --info", folder_);
  EXPECT_TRUE(std::regex_search(info.output, std::regex("rover/beacons / +30 / ?10\\.000 / ?2\\.900"))) << info.output;
  const ToolRun text = runTool("rawlog-edit -i run.rawlog --describe", folder_);
  EXPECT_EQ(text.exit_code, 0) << text.output;
  EXPECT_NE(text.output.find("CObservationBeaconRanges"), std::string::npos);
}

TEST_F(StockTools, RawlogEditListsExternalImages) {
  const RobotInfo robot = seeingRobot("rover");
  RawlogWriter writer(in("run.rawlog"), std::span(&robot, 1), RawlogFormat::observations, RawlogImages::external);
  for (std::uint64_t step = 0; step < 6; ++step) {
    const auto readings = sampleReadings(robot, step);
    writer.write(std::span(&readings, 1), {});
  }
  writer.close();
  const ToolRun listed = runTool("rawlog-edit -i run.rawlog --list-images --text-file-output list.txt", folder_);
  EXPECT_EQ(listed.exit_code, 0) << listed.output;
  EXPECT_EQ(linesOf(in("list.txt")), (std::vector<std::string>{"rover_camera_00000000.jpg", "rover_camera_00000002.jpg",
                                                               "rover_camera_00000004.jpg"}));
  // It also finds them: this command embeds each image in a new rawlog.
  const ToolRun packed = runTool("rawlog-edit -i run.rawlog -o packed.rawlog --de-externalize", folder_);
  EXPECT_EQ(packed.exit_code, 0) << packed.output;
  EXPECT_NE(packed.output.find("Entries converted                 : 3"), std::string::npos) << packed.output;
}

TEST_F(StockTools, RawlogEditReadsEmbeddedImages) {
  const RobotInfo robot = seeingRobot("rover");
  RawlogWriter writer(in("run.rawlog"), std::span(&robot, 1));
  for (std::uint64_t step = 0; step < 6; ++step) {
    const auto readings = sampleReadings(robot, step);
    writer.write(std::span(&readings, 1), {});
  }
  writer.close();
  const ToolRun info = runTool("rawlog-edit -i run.rawlog --describe", folder_);
  EXPECT_EQ(info.exit_code, 0) << info.output;
  for (const char* expected : {"rover/camera", "Image size: 48x32 pixels"}) {
    EXPECT_NE(info.output.find(expected), std::string::npos) << expected << " in\n" << info.output;
  }
}

TEST_F(StockTools, RbpfSlamReadsEveryPairOfActionAndSensoryFrame) {
  recordEllipse(in("run.rawlog"), RawlogFormat::sensory_frames);
  const ToolRun slam =
      runTool("rbpf-slam '" ROBOSIM_SOURCE_DIR "/doc/examples/slam/rbpf-slam.ini' run.rawlog", folder_);
  EXPECT_EQ(slam.exit_code, 0) << slam.output;
  // A line a pair: "pair x y z yaw pitch roll time". How good the path is, is left to the particles' chance; NaN is no
  // number here.
  const auto lines = linesOf(folder_ / "rbpf-slam" / "log_estimated_path.txt");
  ASSERT_EQ(lines.size(), static_cast<std::size_t>(kSteps) + 2);  // a pair for each note
  for (const auto& line : lines) {
    double pair = 0, x_m = 0, y_m = 0;
    EXPECT_TRUE(std::istringstream(line) >> pair >> x_m >> y_m) << line;
  }
}

TEST_F(StockTools, IcpSlamCorrectsTheOdometrysPath) {
  const double odometry_rms_m = recordEllipse(in("run.rawlog"), RawlogFormat::observations);
  ASSERT_GT(odometry_rms_m, 0.3);
  const PathError error = icpSlamError(in("run.rawlog"), "rover", "laser", "icp-slam-exact.ini", folder_ / "slam");
  EXPECT_EQ(error.poses, static_cast<std::size_t>(kSteps));
  EXPECT_LT(error.rms_m, 0.15);
  RecordProperty("icp_slam_rms_m", std::to_string(error.rms_m));
}

}  // namespace
}  // namespace robosim
