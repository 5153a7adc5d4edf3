#pragma once
#include <string>
#include <vector>

#include "base/error_list.h"
#include "geometry/solid.h"
#include "world/world.h"

namespace robosim {

/// What a robot takes up at the start.
struct RobotStart {
  std::string name;
  int line = 0;  ///< in the world file
  Circle disc;   ///< covers its body in plan
  HeightSpan heights;
};

/// Adds to `errors` every robot that is not wholly on the surface, or overlaps an object or another robot. Touching is
/// no overlap. Takes time in proportion to the number of robots.
void checkStarts(const World&, const std::vector<RobotStart>&, const std::string& world_file, ErrorList& errors);

}  // namespace robosim
