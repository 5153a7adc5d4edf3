#pragma once
#include <string>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// How far apart two robots of a world may be and still affect each other within a step.
struct Interaction {
  double reach_m = 0;  ///< greatest such distance of their centres, by a collision or a sensor, at the step's end
  double step_m = 0;   ///< length that no robot's motion in a step exceeds
  std::string unlimited_by = {};  ///< what has no such distance, for a log; empty: nothing

  static Interaction of(const World& world, const Fleet& fleet, double period_s);
};

}  // namespace robosim
