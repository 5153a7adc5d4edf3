#include "tests/slam_errors/stock_paths.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/serialization/CArchive.h>

#include "base/angle_units.h"
#include "base/random.h"
#include "recording/observation_writer.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::math::TPose2D;

/// Odometry and scan, alternating, at the times of the scans.
void writeRecording(const ScanSeries& series, const fs::path& file) {
  ObservationWriter recording(file, {});
  mrpt::obs::CObservationOdometry odometry;
  odometry.sensorLabel = "odometry";
  mrpt::obs::CObservation2DRangeScan scan;
  scan.sensorLabel = "laser";
  scan.rightToLeft = true;
  scan.maxRange = static_cast<float>(series.range_max_m);
  scan.sensorPose = mrpt::poses::CPose3D(mrpt::math::TPose3D(series.robot_from_scanner));
  for (const auto& recorded : series.scans) {
    constexpr double kStart_s = 1e9;
    odometry.timestamp = scan.timestamp = mrpt::Clock::fromDouble(kStart_s + recorded.time_s);
    odometry.odometry = mrpt::poses::CPose2D(recorded.odometry.value_or(TPose2D()));
    const std::size_t beams = recorded.ranges_m.size();
    scan.aperture = static_cast<float>(series.step_rad * static_cast<double>(beams - 1));
    scan.resizeScanAndAssign(beams, scan.maxRange, false);
    for (std::size_t i = 0; i < beams; ++i) {
      if (std::isnan(recorded.ranges_m[i])) continue;
      scan.setScanRange(i, static_cast<float>(recorded.ranges_m[i]));
      scan.setScanRangeValidity(i, true);
    }
    recording.write(odometry);
    recording.write(scan);
  }
  recording.commit();
}

std::string mustRunTool(const std::string& command, const fs::path& folder) {
  const ToolRun run = runTool(command, folder);
  if (run.exit_code != 0) {
    throw std::runtime_error(command + " ended with " + std::to_string(run.exit_code) + ":\n" + run.output);
  }
  return run.output;
}

/// A copy of a shipped configuration with other values.
void writeSettings(const std::string& shipped, const std::vector<std::pair<std::string, std::string>>& values,
                   const fs::path& file) {
  std::ifstream in(ROBOSIM_SOURCE_DIR "/doc/examples/slam/" + shipped);
  std::ofstream out(file);
  for (std::string line; std::getline(in, line);) {
    for (const auto& [key, value] : values) {
      if (line.starts_with(key + " ")) line = key + " = " + value;
    }
    out << line << '\n';
  }
  if (!out) throw std::runtime_error(file.string() + ": could not be written");
}

void checkLength(const RobotPath& path, const ScanSeries& series, const std::string& tool) {
  if (path.size() == series.scans.size()) return;
  throw std::runtime_error(tool + ": has estimated " + std::to_string(path.size()) + " poses of " +
                           std::to_string(series.scans.size()));
}

}  // namespace

double rmsBetween(const RobotPath& path, const RobotPath& reference, bool is_aligned) {
  const auto n = static_cast<double>(path.size());
  double turn_rad = 0;
  mrpt::math::TPoint2D from, to;  // centres
  if (is_aligned) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      from += mrpt::math::TPoint2D(path[i].x, path[i].y) * (1 / n);
      to += mrpt::math::TPoint2D(reference[i].x, reference[i].y) * (1 / n);
    }
    double along = 0, across = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double px = path[i].x - from.x, py = path[i].y - from.y;
      const double rx = reference[i].x - to.x, ry = reference[i].y - to.y;
      along += px * rx + py * ry;
      across += px * ry - py * rx;
    }
    turn_rad = std::atan2(across, along);
  }
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  double squares = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double px = path[i].x - from.x, py = path[i].y - from.y;
    const double dx = to.x + c * px - s * py - reference[i].x, dy = to.y + s * px + c * py - reference[i].y;
    squares += dx * dx + dy * dy;
  }
  return std::sqrt(squares / n);
}

ScanSeries dequantised(const ScanSeries& series, std::uint64_t seed) {
  constexpr double kQuantum_m = 0.01;
  Rng rng(seed);
  ScanSeries copy = series;
  for (auto& scan : copy.scans) {
    for (double& range_m : scan.ranges_m) range_m += rng.uniform(-kQuantum_m / 2, kQuantum_m / 2);
  }
  return copy;
}

RobotPath icpSlamPath(const ScanSeries& series, const fs::path& folder) {
  writeRecording(series, folder / "slam.rawlog");
  mustRunTool("icp-slam '" ROBOSIM_SOURCE_DIR "/doc/examples/slam/icp-slam.ini' slam.rawlog", folder);
  RobotPath path;
  std::ifstream lines(folder / "icp-slam" / "log_estimated_path.txt");
  std::size_t entry = 0;
  for (TPose2D pose; lines >> entry >> pose.x >> pose.y >> pose.phi;) {
    if (entry % 2 == 1) path.push_back(pose);  // of a scan
  }
  checkLength(path, series, "icp-slam");
  return path;
}

RobotPath localizationPath(const ScanSeries& series, const mrpt::maps::COccupancyGridMap2D& map, const TPose2D& start,
                           const fs::path& folder) {
  writeRecording(series, folder / "scans.rawlog");
  {
    mrpt::io::CFileGZOutputStream file((folder / "start.gridmap").string());
    mrpt::serialization::archiveFrom(file) << map;
  }
  const auto at = [](double value_m) { return std::to_string(value_m); };
  constexpr double kAbout_m = 0.5;
  writeSettings("pf-localization.ini",
                {{"map_file", "start.gridmap"},
                 {"ground_truth_path_file", ""},
                 {"init_PDF_min_x", at(start.x - kAbout_m)},
                 {"init_PDF_max_x", at(start.x + kAbout_m)},
                 {"init_PDF_min_y", at(start.y - kAbout_m)},
                 {"init_PDF_max_y", at(start.y + kAbout_m)}},
                folder / "localization.ini");
  const std::string output = mustRunTool("pf-localization localization.ini", folder);
  RobotPath path;
  const std::string before = "PDF estimation: (";
  for (auto i = output.find(before); i != std::string::npos; i = output.find(before, i + 1)) {
    TPose2D pose;
    if (std::sscanf(output.c_str() + i + before.size(), "%lf,%lf,%lf", &pose.x, &pose.y, &pose.phi) == 3) {
      pose.phi *= kRadPerDeg;
      path.push_back(pose);
    }
  }
  checkLength(path, series, "pf-localization");
  return path;
}

}  // namespace robosim
