#pragma once

namespace robosim {

inline constexpr double kMmPerM = 1000;
/// Half the track [mm] that ARIA assumes for a Pioneer 3-DX: 1 / its DiffConvFactor of 0.0056.
inline constexpr double kHalfTrack_mm = 178.6;

}  // namespace robosim
