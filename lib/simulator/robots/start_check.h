#pragma once
#include <string>
#include <vector>

#include "base/error_list.h"
#include "geometry/shapes/solid.h"
#include "world/world.h"

namespace robosim {

/// Space occupied by a robot at the start.
struct RobotStart {
  std::string name;
  SourceLine line;
  Circle disc;  ///< covers its body in plan
  HeightSpan heights;
  Outline outline = {};  ///< of the body, which may be a box within the disc
};

/// Adds to `errors` every robot that is not entirely on the surface, or overlaps an object or another robot. Touching
/// is not an overlap. Takes linear time in the number of robots.
void checkStarts(const World&, const std::vector<RobotStart>&, const std::string& world_file, ErrorList& errors);
/// Adds to `errors` every movable object that is not entirely on the surface, or overlaps another object or a wall.
void checkMovableObjects(const World&, const std::string& world_file, ErrorList& errors);

}  // namespace robosim
