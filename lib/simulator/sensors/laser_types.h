#pragma once
#include <string>
#include <string_view>

#include "sensors/laser_errors.h"

namespace robosim {

/// Errors of a commercial scanner, selected by <laser noise="…">.
struct LaserType {
  std::string_view name;
  LaserErrors errors;
  double sweep_s = 0;  ///< from the first to the last beam
};

/// Names of all types, for messages.
inline constexpr const char* kLaserTypeNames = "lms200, urg04lx, utm30lx";

/// Null for an unknown name.
const LaserType* laserTypeNamed(const std::string& name);

}  // namespace robosim
