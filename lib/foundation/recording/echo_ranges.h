#pragma once
#include "hardware/measurement.h"
#include "recording/observed_numbers.h"

namespace robosim {

/// Range in CObservationRange for a beam without an echo [m]: slightly more than the sensor's maximum. MRPT's maps
/// ignore ranges beyond the maximum, but not all of them ignore 0.
inline float recordedNoEcho(const SensorInfo& sensor) { return static_cast<float>(sensor.range_max_m * 1.001); }

inline bool isNoEcho(const SensorInfo& sensor, float range_m) {
  return range_m >= static_cast<float>(sensor.no_echo_m);
}

/// The echo of a beam at a recorded range; its point is on the beam's axis.
inline Echo echoAlong(const SensorInfo& sensor, std::size_t beam, float pan_rad, float range_m) {
  const Beam& along = sensor.beams[beam];
  const double own_pan_rad = sensor.pans ? pan_rad : 0;
  return {range_m, pointAlong(originOf(along), directionOf(along, own_pan_rad), range_m)};
}

/// The range of a beam as a number.
inline ObservedNumber observedRange(std::size_t beam, float range_m, bool has_echo) {
  const auto& field = std::get<0>(Description<Echoes>::fields);
  ObservedNumber number{field.name, beam, field.unit, {}};
  if (has_echo) number.value = range_m;
  return number;
}

}  // namespace robosim
