#pragma once
#include <algorithm>

namespace robosim {

/// Latest part of each path, which does not fade [simulated s].
inline constexpr double kRecentPath_s = 20;

/// Share by which the older parts of all paths are mixed with the floor's colour, in [0, 0.85], so that together they
/// cover the picture no more than 4 % of it would at full opacity.
/// @param covered share of the picture that they cover
inline float pathFading(double covered) {
  constexpr double kBright = 0.04, kMost = 0.85;
  return static_cast<float>(std::clamp(1 - kBright / std::max(1e-9, covered), 0.0, kMost));
}

}  // namespace robosim
