#pragma once
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "calibration/standing_scans.h"
#include "geometry/shapes/solid.h"
#include "sensors/laser_errors.h"

namespace robosim {

/// The reflectivity of each solid at which the beams of a recording that meet it are most likely to have an echo or
/// none, as recorded, by the model of LaserErrors (reach_m and fading). Beams that received the echo of another surface
/// do not count. kReflectivity for solids that no beam meets.
/// @param path pose of the robot at each scan
std::vector<float> computeReflectivities(const std::vector<Solid>& solids, const ScanSeries& recorded,
                                         const std::vector<mrpt::math::TPose2D>& path, const LaserErrors& errors);

}  // namespace robosim
