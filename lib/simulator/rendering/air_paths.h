#pragma once
#include <vector>

#include "rendering/air_view.h"
#include "rendering/color.h"
#include "rendering/detail_level.h"
#include "rendering/drawing_surface.h"

namespace robosim {

/// Draws the paths of the shown robots on the ground, where nothing hides them. Where old parts would cover much of the
/// picture, they fade; the paths of many robots are thinner, and fade with age (path_fading.h).
/// @param colors of the robots
void drawAirPaths(DrawingSurface& surface, const AirPicture& air, const AirView& view, const RunSnapshot& snapshot,
                  const std::vector<Color>& colors, const RunPaths& paths, const ViewLayers& layers,
                  const DetailLevel& level);

}  // namespace robosim
