#pragma once

namespace robosim {

/// The opening angle [rad] of an mrpt::obs::CObservationRange. MRPT 2.14 corrected the member's spelling
/// (`sensorConeApperture` up to 2.5); the file format is the same.
template <typename RangeObservation>
auto& coneAperture(RangeObservation& range) {
  if constexpr (requires { range.sensorConeAperture; }) {
    return range.sensorConeAperture;
  } else {
    return range.sensorConeApperture;
  }
}

}  // namespace robosim
