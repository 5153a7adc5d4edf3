#pragma once
#include <string>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// Plan of a world as an SVG document (https://www.w3.org/TR/SVG11/), to scale: one unit is a metre, x to the right and
/// y upwards, so that a world point (x, y) is drawn at (x, -y). It shows the floor with a grid and a scale, maps,
/// objects in their colours, hot ones with a glow and their names, and the robots at their start poses, each with its
/// name and a heading line.
std::string toSvg(const World&, const Fleet&);

}  // namespace robosim
