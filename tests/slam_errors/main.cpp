// Errors of stock SLAM programs on a real recording and on its simulated equivalent:
//   robosim_slam_errors RAWLOG ROBOT_TYPE SEEDS
// 1. Offline SLAM of the recording gives a path, and the surfaces that its scans show.
// 2. A robot of the type drives the same path among these surfaces, whose reflectivity loses as many echoes as the
// recording, with other random errors for each seed.
// 3. For the recording and for each drive alike: offline SLAM, its map, and the RMS distances of the paths of icp-slam
// (after alignment) and pf-localization (on that map) from the offline path. icp-slam amplifies differences of
// millimetres, so that its error on one recording is a sample of a distribution; copies with dequantised readings show
// it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numeric>

#include "base/temporary_directory.h"
#include "base/text_table.h"
#include "tests/slam_errors/scan_registration.h"
#include "tests/slam_errors/simulated_drive.h"
#include "tests/slam_errors/stock_paths.h"
#include "tests/slam_errors/surface_grid.h"
#include "tests/slam_errors/surface_light.h"

namespace robosim {
namespace {

constexpr std::uint64_t kCopies = 20;

struct Errors {
  double residual_m = 0, odometry_m = 0, localization_m = 0;
  double icp_slam_m = 0;                ///< of the readings as they are
  std::vector<double> icp_slam_copy_m;  ///< of dequantised copies, ascending
};

double computeMean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// @param share of the values that are smaller
double computeQuantile(const std::vector<double>& ascending, double share) {
  return ascending[static_cast<std::size_t>(std::lround(share * static_cast<double>(ascending.size() - 1)))];
}

RobotPath odometryOf(const ScanSeries& series) {
  RobotPath path;
  for (const auto& scan : series.scans) path.push_back(scan.odometry.value_or(mrpt::math::TPose2D()));
  return path;
}

Errors errorsOf(const ScanSeries& series, const Registration& offline) {
  const TemporaryDirectory folder;
  const SurfaceGrid surfaces(series, offline.start_from_robot);
  const RobotPath& path = offline.start_from_robot;
  Errors errors{.residual_m = offline.residual_m,
                .odometry_m = rmsBetween(odometryOf(series), path, true),
                .localization_m =
                    rmsBetween(localizationPath(series, surfaces.gridmap(), path.front(), folder.path()), path, false),
                .icp_slam_m = rmsBetween(icpSlamPath(series, folder.path()), path, true),
                .icp_slam_copy_m = {}};
  for (std::uint64_t copy = 1; copy <= kCopies; ++copy) {
    const TemporaryDirectory of_copy;
    errors.icp_slam_copy_m.push_back(rmsBetween(icpSlamPath(dequantised(series, copy), of_copy.path()), path, true));
  }
  std::sort(errors.icp_slam_copy_m.begin(), errors.icp_slam_copy_m.end());
  return errors;
}

std::vector<std::string> rowOf(const std::string& name, const Errors& errors) {
  const auto& copies = errors.icp_slam_copy_m;
  return {name,
          fixed(errors.residual_m, 3),
          fixed(errors.odometry_m, 2),
          fixed(errors.localization_m, 3),
          fixed(errors.icp_slam_m, 3),
          fixed(computeMean(copies), 3),
          fixed(computeQuantile(copies, 0.1), 3),
          fixed(computeQuantile(copies, 0.5), 3),
          fixed(computeQuantile(copies, 0.9), 3)};
}

void measure(const std::string& rawlog, const std::string& robot_type, std::uint64_t seeds) {
  constexpr double kClear_m = 0.9;  // about the robot; nearer surfaces are those of persons that went by
  const ScanSeries recorded = readScans(rawlog, "");
  const Registration offline = registerScans(recorded);
  const SurfaceGrid surfaces(recorded, offline.start_from_robot);
  SimulatedSurroundings around{surfaces.solids(offline.start_from_robot, kClear_m), {}};
  around.reflectivity =
      computeReflectivities(around.solids, recorded, offline.start_from_robot, laserOf(robot_type).errors);
  Rows rows{{"drive", "scans off surfaces", "odometry", "pf-localization", "icp-slam", "of copies, mean", "10 %",
             "50 %", "90 %"}};
  const Errors real = errorsOf(recorded, offline);
  rows.push_back(rowOf("recorded", real));
  std::cerr << around.solids.size() << " solids\n" << table(rows) << std::flush;
  Errors mean;
  const auto share = 1 / static_cast<double>(seeds);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const ScanSeries drive = simulateDrive(recorded, offline.start_from_robot, around, robot_type, seed);
    const Errors errors = errorsOf(drive, registerScans(drive));
    rows.push_back(rowOf("seed " + std::to_string(seed), errors));
    std::cerr << table({rows.back()}) << std::flush;
    mean.residual_m += share * errors.residual_m;
    mean.odometry_m += share * errors.odometry_m;
    mean.localization_m += share * errors.localization_m;
    mean.icp_slam_m += share * errors.icp_slam_m;
    mean.icp_slam_copy_m.insert(mean.icp_slam_copy_m.end(), errors.icp_slam_copy_m.begin(),
                                errors.icp_slam_copy_m.end());
  }
  auto& copies = mean.icp_slam_copy_m;
  std::sort(copies.begin(), copies.end());
  rows.push_back(rowOf("all seeds", mean));
  const auto larger = std::count_if(copies.begin(), copies.end(), [&](double m) { return m >= real.icp_slam_m; });
  std::cout << table(rows) << "Simulated by recorded: pf-localization "
            << fixed(mean.localization_m / real.localization_m, 2) << ", icp-slam "
            << fixed(computeMean(copies) / computeMean(real.icp_slam_copy_m), 2) << " (copies), "
            << fixed(mean.icp_slam_m / real.icp_slam_m, 2) << " (as recorded). " << larger << " of " << copies.size()
            << " simulated copies have at least the error of the recording.\n";
}

}  // namespace
}  // namespace robosim

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "Usage: robosim_slam_errors RAWLOG ROBOT_TYPE SEEDS\n";
    return 2;
  }
  try {
    robosim::measure(argv[1], argv[2], std::stoul(argv[3]));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "robosim_slam_errors: " << error.what() << '\n';
    return 2;
  }
}
