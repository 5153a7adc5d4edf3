#pragma once
#include <cstdint>

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation.h>

#include "hardware/measurement.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Classification of an observation for drawing. `out_of_range` has coordinates or ranges that are not finite, or too
/// large for a map.
enum class ObservationKind : std::uint8_t { ignored, out_of_range, truth, odometry, scan, ranges, heat };

ObservationKind observationKind(const mrpt::obs::CObservation& observation);
inline bool isPose(ObservationKind kind) { return kind == ObservationKind::truth || kind == ObservationKind::odometry; }

/// @pre isPose() of its kind
mrpt::math::TPose2D observedPose(const mrpt::obs::CObservation& observation);

/// @pre the kind is scan, ranges or heat
Measurement observedMeasurement(const mrpt::obs::CObservation& observation);
/// The measurement of a sensor that has not been observed yet.
Measurement emptyMeasurement(const SensorInfo& sensor);

/// Updates the description of a sensor from a further observation.
/// @pre the kind is scan, ranges or heat
void updateDescription(SensorInfo& sensor, const mrpt::obs::CObservation& observation);

/// Bounding box [m] of the nearest 90 % of an observation's echoes, in the robot's frame; a few distant echoes, as
/// through a window, would enlarge the view too much.
struct Surroundings {
  float x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};
Surroundings observedSurroundings(const mrpt::obs::CObservation& observation);

}  // namespace robosim
