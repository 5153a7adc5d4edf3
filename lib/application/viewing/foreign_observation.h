#pragma once
#include <cstdint>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation.h>

#include "hardware/measurement.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Classification of an observation for drawing. `out_of_range` has coordinates or ranges that are not finite, or too
/// large for a map. `points` are those of 3D scanners and depth cameras, as a cloud.
enum class ObservationKind : std::uint8_t {
  ignored,
  out_of_range,
  truth,
  odometry,
  satellites,  ///< a position of a satellite receiver
  scan,
  ranges,
  heat,
  points,
  bearings,
  beacons,
};

ObservationKind observationKind(const mrpt::obs::CObservation& observation);
inline bool isPose(ObservationKind kind) {
  return kind == ObservationKind::truth || kind == ObservationKind::odometry || kind == ObservationKind::satellites;
}

/// @pre the kind is truth or odometry
mrpt::math::TPose2D observedPose(const mrpt::obs::CObservation& observation);

/// A geodetic position [degrees].
struct Geodetic {
  double latitude_deg = 0, longitude_deg = 0;
};
/// @pre the kind is satellites
Geodetic observedPosition(const mrpt::obs::CObservation& observation);
/// East (x) and north (y) of an origin [m], on the plane that touches the ellipsoid WGS 84 there.
mrpt::math::TPoint2D localMetres(const Geodetic& origin, const Geodetic& position);

/// @pre the kind is neither ignored, out_of_range nor isPose()
Measurement observedMeasurement(const mrpt::obs::CObservation& observation);
/// The measurement of a sensor that has not been observed yet.
Measurement emptyMeasurement(const SensorInfo& sensor);

/// Updates the description of a sensor from a further observation.
/// @pre the kind is neither ignored, out_of_range nor isPose()
void updateDescription(SensorInfo& sensor, const mrpt::obs::CObservation& observation);

/// Bounding box [m] of the nearest 90 % of an observation's echoes, in the robot's frame; a few distant echoes, as
/// through a window, would enlarge the view too much.
struct Surroundings {
  float x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};
Surroundings observedSurroundings(const mrpt::obs::CObservation& observation);

}  // namespace robosim
