#pragma once
#include <cstddef>
#include <vector>

#include "hardware/readings.h"
#include "hardware/sensor_info.h"
#include "maze/surface_point.h"

namespace robosim {

/// Adds the points of a scan, every `stride`-th, at which its neighbours lie on a line: total least squares over the
/// beams around it. Frame: robot.
void addLaserSurfaces(const SensorInfo& sensor, const Echoes& echoes, std::size_t stride,
                      std::vector<SurfacePoint>& points);

}  // namespace robosim
