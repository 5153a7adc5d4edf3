#pragma once
#include <cstdint>
#include <string>

#include "base/error_list.h"
#include "robots/robot_types.h"
#include "world/world.h"

namespace robosim {

/// Replaces the World::scatters by their robots and objects, which follow those that the world already has, scatter by
/// scatter. A copy keeps the scatter's gap to every solid, robot and earlier copy whose heights overlap its own,
/// measured from the disc that covers it in plan, and lies on the surface. The result depends only on the arguments and
/// is the same on every processor. Takes linear time in the number of copies, except where little room is left.
/// @param world_file names the world's file in errors
/// @param errors faults of the scattered robots' models, and scatters without enough room; after earlier errors nothing
/// is placed
void placeScattered(World& world, const std::string& world_file, const RobotTypes& types, std::uint64_t seed,
                    ErrorList& errors);

}  // namespace robosim
