#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "calibration/standing_scans.h"
#include "geometry/shapes/solid.h"
#include "sensors/laser.h"

namespace robosim {

/// What a robot drives among.
struct SimulatedSurroundings {
  std::vector<Solid> solids;
  std::vector<float> reflectivity;  ///< of each solid
};

/// The <laser> of a robot type. @throws ConfigError for an invalid robot type
LaserOptions laserOf(const std::string& robot_type);

/// The scans and odometry that a robot type's <laser> and <odometry> would have recorded on the path of a recording,
/// among solids. Scans of the mean age are those from the poses of the path. The robot moves on arcs between these, and
/// at the recorded speed, averaged over 2 s: the time stamps of single scans are wrong.
/// @param robot_type its XML file
/// @throws ConfigError for an invalid robot type
ScanSeries simulateDrive(const ScanSeries& recorded, const std::vector<mrpt::math::TPose2D>& path,
                         const SimulatedSurroundings& around, const std::string& robot_type, std::uint64_t seed);

}  // namespace robosim
