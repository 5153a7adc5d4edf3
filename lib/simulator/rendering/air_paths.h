#pragma once
#include <vector>

#include "rendering/air_view.h"
#include "rendering/color.h"
#include "rendering/detail_level.h"
#include "rendering/drawing_surface.h"

namespace robosim {

/// Draws the paths of all robots on the ground, where nothing hides them. Where old parts would cover much of the
/// picture, they fade (path_fading.h).
/// @param colors of the robots @param from_s earliest time that is drawn @param level with many robots, all paths are
/// thinner and fade
void drawAirPaths(DrawingSurface& surface, const AirPicture& air, const AirView& view, const RunSnapshot& snapshot,
                  const std::vector<Color>& colors, const RunPaths& paths, double from_s, const DetailLevel& level);

}  // namespace robosim
