#include "wire/plausible_echoes.h"

#include <cmath>

#include "base/portable_math.h"

namespace robosim {
namespace {

/// Tolerance of single-precision points: relative to their distance [1], and at least this [m].
constexpr double kTolerance = 1e-4;

std::string faultOf(const Echo& echo, const Beam& beam, const SensorInfo& sensor) {
  const auto range_min_m = static_cast<float>(sensor.range_min_m);
  const auto range_max_m = static_cast<float>(sensor.range_max_m);
  const auto no_echo_m = static_cast<float>(sensor.no_echo_m);
  const float range_m = echo.range_m;
  if (!(range_m >= range_min_m && range_m <= range_max_m) && range_m != no_echo_m) {
    return "a range of " + std::to_string(range_m) + " m; it must lie in [" + std::to_string(range_min_m) + ", " +
           std::to_string(range_max_m) + "] m, or be " + std::to_string(no_echo_m) + " m where nothing is in range";
  }
  const auto origin = originOf(beam);
  const double across_m = portable::hypot(echo.point_m.x - origin.x, echo.point_m.y - origin.y);
  const double distance_m = portable::hypot(across_m, echo.point_m.z - origin.z);
  const double tolerance_m = kTolerance * (1 + std::abs(range_m));
  // An echo nearer than range_min_m has the range range_min_m, and its point is the actual intersection.
  const bool is_at_range =
      range_m == range_min_m ? distance_m <= range_m + tolerance_m : std::abs(distance_m - range_m) <= tolerance_m;
  if (is_at_range) return "";
  return "a point " + std::to_string(distance_m) + " m from its beam's origin, with a range of " +
         std::to_string(range_m) + " m";
}

}  // namespace

std::string faultOf(const Echoes& echoes, const SensorInfo& sensor) {
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const std::string fault = faultOf(echoes[i], sensor.beams[i], sensor);
    if (!fault.empty()) return sensor.label + ", beam " + std::to_string(i) + ": " + fault;
  }
  return "";
}

}  // namespace robosim
