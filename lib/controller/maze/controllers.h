#pragma once
#include "control/controller_registry.h"

namespace robosim {

/// The controllers of this program: gold_finder, other searches for gold, wander, wall_follower, still. Others may be
/// added before the first run starts.
ControllerRegistry& controllers();

}  // namespace robosim
