#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/math/TPose2D.h>

#include "calibration/standing_scans.h"

namespace robosim {

using RobotPath = std::vector<mrpt::math::TPose2D>;

/// RMS distance of two paths. @param is_aligned moves one of them by the rigid motion that makes it smallest (J. Sturm
/// et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012)
double rmsBetween(const RobotPath& path, const RobotPath& reference, bool is_aligned);

/// A copy of a drive whose readings, which are in centimetres, are dequantised: changed by a uniform random number
/// within ±5 mm.
ScanSeries dequantised(const ScanSeries& series, std::uint64_t seed);

/// The path that stock icp-slam estimates at each scan, with doc/examples/slam/icp-slam.ini.
/// @throws std::runtime_error with its output if it fails
RobotPath icpSlamPath(const ScanSeries& series, const std::filesystem::path& folder);

/// The path that stock pf-localization estimates, with doc/examples/slam/pf-localization.ini, a map, and an
/// area of 1 m about the first pose. @throws as icpSlamPath()
RobotPath localizationPath(const ScanSeries& series, const mrpt::maps::COccupancyGridMap2D& map,
                           const mrpt::math::TPose2D& start, const std::filesystem::path& folder);

}  // namespace robosim
