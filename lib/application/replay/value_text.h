#pragma once
#include <optional>
#include <string>

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation.h>

#include "hardware/command.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// "0.300 m/s, 0.000 rad/s, found"
std::string inWords(const Command& command);
/// The measurement as one line of printable text; the class name for unsupported classes.
/// @param sensor its description (RecordedSensors); null if unknown
std::string inWords(const mrpt::obs::CObservation& observation, const SensorInfo* sensor = nullptr);

/// The observation's class without its namespace.
std::string classOf(const mrpt::obs::CObservation& observation);
/// Ground truth pose and odometry pose.
std::optional<mrpt::math::TPose2D> poseIn(const mrpt::obs::CObservation& observation);

}  // namespace robosim
