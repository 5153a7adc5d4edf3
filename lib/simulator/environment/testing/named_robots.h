#pragma once
#include <string>
#include <vector>

#include "robots/fleet.h"

namespace robosim {

/// Robots that have nothing but names.
inline std::vector<FleetRobot> namedRobots(const std::vector<std::string>& names) {
  std::vector<FleetRobot> robots(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) robots[i].info.name = names[i];
  return robots;
}

}  // namespace robosim
