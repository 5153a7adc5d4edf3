#pragma once
#include <string>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// A plan of a world as an SVG document (https://www.w3.org/TR/SVG11/), to scale: one unit is a metre, x to the right,
/// and y upwards, so that a place (x, y) of the world is drawn at (x, -y). It shows the surface with a grid and a
/// scale, what maps have, objects in their colours, hot ones with a glow and their names, and the robots where they
/// start, each with its name and a line ahead.
std::string toSvg(const World&, const Fleet&);

}  // namespace robosim
