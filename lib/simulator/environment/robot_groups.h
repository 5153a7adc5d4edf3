#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "environment/robot_range.h"
#include "robots/fleet.h"
#include "sensors/sensor.h"

namespace robosim {

/// Robots with the same model.
struct RobotGroup {
  const RobotModel* model;
  double reach_m;  ///< maximum range, from their centres, of a step and of the sensors that use neighbours
  std::vector<std::uint32_t> robots;  ///< in ascending order

  /// The robots of the group within a range.
  std::span<const std::uint32_t> within(RobotRange range) const;
};

/// The robots of a fleet, by model.
struct RobotGroups {
  /// @param period_s length of a time step
  RobotGroups(const Fleet& fleet, double period_s);
  const RobotGroup& groupOf(std::size_t robot) const { return groups[number_of[robot]]; }

  std::vector<RobotGroup> groups;
  std::vector<std::uint32_t> number_of;  ///< of the group, by robot
};

/// Maximum range from a robot's centre in which a sensor uses neighbours [m]; 0 if it uses none.
double reachOf(const Sensor& sensor);

}  // namespace robosim
