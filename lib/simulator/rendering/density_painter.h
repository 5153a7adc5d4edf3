#pragma once
#include "rendering/air_overlay.h"
#include "rendering/density_map.h"
#include "rendering/drawing_surface.h"

namespace robosim {

inline constexpr double kDensityScale_px = 72;  ///< width of the scale of colours

/// Colours the cells of a map on the floor.
void drawDensity(DrawingSurface&, const DensityMap&);
/// The same on a rendered 3D picture, where nothing stands on the ground.
void tintGround(const AirPicture&, const DensityMap&);
/// The colours of the levels side by side. @param center in pixels @param scale of the size
void drawDensityScale(DrawingSurface&, const mrpt::math::TPoint2D& center, double scale = 1);
/// The scale with its numbers and unit in the lower right corner of a picture.
/// @param scale of text and lines
void drawDensityLegend(DrawingSurface&, const DensityMap&, double scale = 1);

}  // namespace robosim
