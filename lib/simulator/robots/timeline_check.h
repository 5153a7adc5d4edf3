#pragma once
#include <string>

#include "base/error_list.h"
#include "world/world.h"

namespace robosim {

/// Adds an error for each change of World::timeline whose robot or object the world will not have by then.
/// @param world without scatters @param world_file names the file in errors
void checkTimeline(const World& world, const std::string& world_file, ErrorList& errors);

}  // namespace robosim
