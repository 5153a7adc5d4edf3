#pragma once
#include <mrpt/obs/CObservation.h>

#include "hardware/measurement.h"

namespace robosim {

/// Whether an observation is a cloud of points: of a depth camera, or of a 3D scanner of Velodyne.
bool isCloud(const mrpt::obs::CObservation& observation);

/// Points of a cloud in the robot's frame, as echoes: those that are finite and within kMapReach_m, in larger clouds
/// evenly chosen ones. None of a scan without its calibration, and of an unknown model.
/// @pre isCloud()
Echoes pointsOf(const mrpt::obs::CObservation& observation);

}  // namespace robosim
