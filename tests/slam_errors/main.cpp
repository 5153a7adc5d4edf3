// Errors of stock SLAM programs on a real recording and on its simulated equivalent:
//   robosim_slam_errors RAWLOG ROBOT_TYPE SEEDS
// 1. Offline SLAM of the recording gives a path, and the surfaces that its scans show.
// 2. A robot of the type drives the same path among these surfaces, with other random errors for each seed.
// 3. For the recording and for each drive alike: offline SLAM, its map, and the RMS distances of the paths of icp-slam
// (after
//    alignment) and pf-localization (on that map) from the offline path.
#include <filesystem>
#include <iostream>

#include "base/temporary_directory.h"
#include "base/text_table.h"
#include "tests/slam_errors/scan_registration.h"
#include "tests/slam_errors/simulated_drive.h"
#include "tests/slam_errors/stock_paths.h"
#include "tests/slam_errors/surface_grid.h"

namespace robosim {
namespace {

struct Errors {
  double residual_m = 0, icp_slam_m = 0, localization_m = 0, odometry_m = 0;
};

RobotPath odometryOf(const ScanSeries& series) {
  RobotPath path;
  for (const auto& scan : series.scans) path.push_back(scan.odometry.value_or(mrpt::math::TPose2D()));
  return path;
}

Errors errorsOf(const ScanSeries& series, const Registration& offline) {
  const TemporaryDirectory folder;
  const SurfaceGrid surfaces(series, offline.start_from_robot);
  const RobotPath& path = offline.start_from_robot;
  return {.residual_m = offline.residual_m,
          .icp_slam_m = rmsBetween(icpSlamPath(series, folder.path()), path, true),
          .localization_m =
              rmsBetween(localizationPath(series, surfaces.gridmap(), path.front(), folder.path()), path, false),
          .odometry_m = rmsBetween(odometryOf(series), path, true)};
}

std::vector<std::string> rowOf(const std::string& name, const Errors& errors) {
  return {name, fixed(errors.residual_m, 3), fixed(errors.odometry_m, 2), fixed(errors.icp_slam_m, 3),
          fixed(errors.localization_m, 3)};
}

void measure(const std::string& rawlog, const std::string& robot_type, std::uint64_t seeds) {
  constexpr double kClear_m = 0.9;  // about the robot; nearer surfaces are those of persons that went by
  const ScanSeries recorded = readScans(rawlog, "");
  const Registration offline = registerScans(recorded);
  const SurfaceGrid surfaces(recorded, offline.start_from_robot);
  const std::vector<Solid> solids = surfaces.solids(offline.start_from_robot, kClear_m);
  Rows rows{{"drive", "scans off surfaces", "odometry", "icp-slam", "pf-localization"}};
  const Errors real = errorsOf(recorded, offline);
  rows.push_back(rowOf("recorded", real));
  std::cerr << solids.size() << " solids\n" << table(rows) << std::flush;
  Errors mean;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const ScanSeries drive = simulateDrive(recorded, offline.start_from_robot, solids, robot_type, seed);
    const Registration simulated = registerScans(drive);
    const Errors errors = errorsOf(drive, simulated);
    rows.push_back(rowOf("seed " + std::to_string(seed), errors));
    std::cerr << table({rows.back()}) << std::flush;
    const auto share = 1 / static_cast<double>(seeds);
    mean.residual_m += share * errors.residual_m;
    mean.odometry_m += share * errors.odometry_m;
    mean.icp_slam_m += share * errors.icp_slam_m;
    mean.localization_m += share * errors.localization_m;
  }
  rows.push_back(rowOf("mean of seeds", mean));
  std::cout << table(rows) << "Simulated by recorded: icp-slam " << fixed(mean.icp_slam_m / real.icp_slam_m, 2)
            << ", pf-localization " << fixed(mean.localization_m / real.localization_m, 2) << '\n';
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
