#pragma once
#include <string>
#include <vector>

#include "hardware/sensor_info.h"

namespace robosim {

/// The quantities of a sensor of SensorKind::values that measures the same of several things: those of a record, each
/// with the number of the thing, from 1: `range_1`, `bearing_1`, `range_2`, …
inline std::vector<Quantity> numberedQuantities(std::size_t count, const std::vector<Quantity>& record) {
  std::vector<Quantity> quantities;
  quantities.reserve(count * record.size());
  for (std::size_t i = 1; i <= count; ++i) {
    for (const Quantity& one : record) quantities.push_back({one.name + "_" + std::to_string(i), one.unit});
  }
  return quantities;
}

/// @name Sensors that measure where things are
/// Each record begins with what the thing is, -1 for none, its range [m] and its bearing [rad].
///@{
/// Range and bearing: `robot_i`, the index in the world, `range_i`, `bearing_i`.
inline std::vector<Quantity> neighbourQuantities(std::size_t count) {
  return numberedQuantities(count, {{"robot", ""}, {"range", "m"}, {"bearing", "rad"}});
}
/// Omnidirectional camera: `color_i`, 0xRRGGBB, `range_i`, `bearing_i`.
inline std::vector<Quantity> blobQuantities(std::size_t count) {
  return numberedQuantities(count, {{"color", ""}, {"range", "m"}, {"bearing", "rad"}});
}
/// Fiducial marks: `id_i`, 0 if it is too far to be read, `range_i`, `bearing_i`, `orientation_i`.
inline std::vector<Quantity> fiducialQuantities(std::size_t count) {
  return numberedQuantities(count, {{"id", ""}, {"range", "m"}, {"bearing", "rad"}, {"orientation", "rad"}});
}
/// Number of values in a record of such a sensor; 0 for any other one.
inline std::size_t sightingSize(const SensorInfo& sensor) {
  const auto& all = sensor.quantities;
  if (sensor.kind != SensorKind::values || all.empty()) return 0;
  if (all == neighbourQuantities(all.size() / 3) || all == blobQuantities(all.size() / 3)) return 3;
  return all == fiducialQuantities(all.size() / 4) ? 4 : 0;
}
///@}

}  // namespace robosim
