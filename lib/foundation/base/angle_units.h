#pragma once
#include <cmath>

namespace robosim {

inline constexpr double kRadPerDeg = M_PI / 180;

}  // namespace robosim
