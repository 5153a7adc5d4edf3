#pragma once
#include <array>
#include <cstddef>
#include <optional>

#include "robots/fleet.h"

namespace robosim {

/// Distinguishable colours (red, green, blue, each in [0, 1]): eight of a fixed palette first, then hues in steps of
/// the golden angle.
std::array<float, 3> paletteColor(std::size_t robot);

/// Decides the colour of each robot of a fleet, for all views, plans, camera pictures and the console: the colour given
/// in the world file; else that of the type, if no other robot without a colour has the same; else paletteColor(). A
/// body of 2005 in the default grey counts as one without a colour. Sets FleetRobot::body.color
/// and info.color_rgb.
void setRobotColors(const World& world, Fleet& fleet);

/// Decides the colour of the last robot of a fleet, which has been added to it, as above; the others keep theirs.
/// @param own the colour given for it
void setColorOfLast(Fleet& fleet, const std::optional<std::array<float, 3>>& own);

}  // namespace robosim
