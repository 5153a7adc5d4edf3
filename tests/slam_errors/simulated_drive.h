#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "calibration/standing_scans.h"
#include "geometry/shapes/solid.h"

namespace robosim {

/// The scans and odometry that a robot type's <laser> and <odometry> would have recorded on the path of a recording,
/// among solids. The path consists of arcs between the recorded poses, and is driven at the recorded speed, averaged
/// over 2 s: the time stamps of single scans are wrong.
/// @param robot_type its XML file
/// @throws ConfigError for an invalid robot type
ScanSeries simulateDrive(const ScanSeries& recorded, const std::vector<mrpt::math::TPose2D>& path,
                         const std::vector<Solid>& solids, const std::string& robot_type, std::uint64_t seed);

}  // namespace robosim
