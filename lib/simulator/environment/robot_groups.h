#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "environment/robot_range.h"
#include "robots/fleet.h"
#include "sensors/sensor.h"

namespace robosim {

/// Whether the sensor of a robot is computed, by its slot. Null: all are.
using IsSensed = std::function<bool(std::size_t robot, std::size_t slot)>;

/// Robots with the same model, whose same sensors are computed.
struct RobotGroup {
  const RobotModel* model;
  /// Slots of the sensors that are computed, in ascending order: of those that any process may compute, and of those
  /// with Sensor::sensesInHostProcess().
  std::vector<std::size_t> slots, host_slots;
  double reach_m;  ///< maximum range, from their centres, of a step and of those sensors that use neighbours
  std::vector<std::uint32_t> robots;  ///< in ascending order

  /// The robots of the group within a range.
  std::span<const std::uint32_t> within(RobotRange range) const;
};

/// The robots of a fleet, by model and by the sensors that are computed.
struct RobotGroups {
  /// @param period_s length of a time step
  RobotGroups(const Fleet& fleet, double period_s, const IsSensed& is_sensed = nullptr);
  const RobotGroup& groupOf(std::size_t robot) const { return groups[number_of[robot]]; }

  std::vector<RobotGroup> groups;
  bool have_slots = false, have_host_slots = false;  ///< whether any group has such slots
  std::vector<std::uint32_t> number_of;              ///< of the group, by robot
};

/// Maximum range from a robot's centre in which a sensor uses neighbours [m]; 0 if it uses none.
double reachOf(const Sensor& sensor);

}  // namespace robosim
