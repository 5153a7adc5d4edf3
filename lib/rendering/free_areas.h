#pragma once
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "hardware/readings.h"
#include "hardware/sensor_info.h"
#include "robots/run_snapshot.h"

namespace robosim {

/// Areas that one range sensor has measured as free, as polygons [m, world frame]: of a laser with more than two beams
/// the area of the scan, otherwise a sector for each beam, as far as its echo.
/// @param arc_piece_m length of the straight pieces of a sector's arc; at most 12 pieces
std::vector<std::vector<mrpt::math::TPoint2D>> freeAreas(const RobotSnapshot& robot, const SensorInfo& sensor,
                                                         const Echoes& echoes, double arc_piece_m);

}  // namespace robosim
