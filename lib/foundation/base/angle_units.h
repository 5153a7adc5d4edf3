#pragma once
#include <cmath>

namespace robosim {

/// The one conversion between degrees and radians. The functions may differ from a product with the constant in the
/// last bit, on which recorded runs depend: a caller keeps the form that it has.
inline constexpr double kRadPerDeg = M_PI / 180;
inline constexpr double kDegPerRad = 180 / M_PI;

constexpr double toRadians(double angle_deg) { return angle_deg * M_PI / 180; }
constexpr double toDegrees(double angle_rad) { return angle_rad * 180 / M_PI; }

}  // namespace robosim
