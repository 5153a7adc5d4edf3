#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "sensors/image_source.h"
#include "world/changed_objects.h"

namespace robosim {

/// State of a robot at a step, as views show it and as the protocol sends it to viewers.
struct RobotSnapshot {
  mrpt::math::TPose2D world_from_robot;
  float laser_pan_rad = 0;
  bool stalled = false;
  Activity activity = Activity::active;
  std::optional<Readings> readings;  ///< nullopt if not requested
  std::uint32_t led_color = 0;       ///< 0xRRGGBB; 0: off
  bool operator==(const RobotSnapshot&) const = default;
  /// Whether the robot is in the world, and therefore shown.
  bool isPresent() const { return activity != Activity::absent; }
  /// For ImageSource and RunPaths: kNotShown for an absent robot.
  mrpt::math::TPose2D shownPose() const { return isPresent() ? world_from_robot : kNotShown; }
};

/// State of a run at a step, from any source: a live run, a recording, or a world's initial state.
struct RunSnapshot {
  std::uint64_t step = 0;
  double time_s = 0;
  std::vector<RobotSnapshot> robots;  ///< in the world's order
  ChangedObjects objects = {};
};

}  // namespace robosim
