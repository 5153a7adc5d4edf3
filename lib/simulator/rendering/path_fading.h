#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

namespace robosim {

/// Latest part of each path, which does not fade among few robots, and is all that is drawn among many [simulated s].
inline constexpr double kRecentPath_s = 20;

/// Share by which the older parts of all paths are mixed with the floor's colour, in [0, 0.85], so that together they
/// cover the picture no more than 4 % of it would at full opacity.
/// @param covered share of the picture that they cover
inline float pathFading(double covered) {
  constexpr double kBright = 0.04, kMost = 0.85;
  return static_cast<float>(std::clamp(1 - kBright / std::max(1e-9, covered), 0.0, kMost));
}

/// A part of the paths of many robots, by its age.
struct TrailPart {
  double from_s = 0, to_s = 0;
  float paleness = 0;  ///< share of the floor's colour
};

/// The parts of a time range in which paths of many robots are drawn, the oldest and palest first.
/// @param newest paleness of the newest part, [0, 0.92]
inline std::array<TrailPart, 5> trailParts(double from_s, double to_s, float newest) {
  constexpr float kOldest = 0.92f;
  std::array<TrailPart, 5> parts;
  constexpr auto kCount = static_cast<double>(std::tuple_size_v<decltype(parts)>);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double from = static_cast<double>(i) / kCount, to = static_cast<double>(i + 1) / kCount;
    const auto age = static_cast<float>(1 - static_cast<double>(i) / (kCount - 1));
    parts[i] = {from_s + (to_s - from_s) * from, from_s + (to_s - from_s) * to, newest + (kOldest - newest) * age};
  }
  return parts;
}

}  // namespace robosim
