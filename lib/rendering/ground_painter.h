#pragma once
#include <string>
#include <vector>

#include "rendering/drawing_surface.h"
#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// @name Shared by all pictures from above
///@{
inline constexpr Color kPageColor{0.922f, 0.941f, 0.961f};
inline constexpr Color kFloorColor{1, 1, 1};
inline constexpr Color kGridColor{0.882f, 0.902f, 0.922f};
inline constexpr Color kInkColor{0.16f, 0.18f, 0.22f};
inline constexpr Color kGlowColor{1.0f, 0.55f, 0.15f};
inline constexpr Color kWhite{1, 1, 1};
inline constexpr double kTextSize_px = 10;  ///< height of a capital

/// By robot: the colour of its body, as in 3D (robots/robot_colors.h).
std::vector<Color> robotColors(const Fleet&);

/// Spacing of grid lines [m], a round number.
double gridStep(const GroundView&);
/// The ground within the world's bounds, with a grid.
void drawFloor(DrawingSurface&, const Bounds2D& bounds);
/// The walls of the world's maps.
void drawMaps(DrawingSurface&, const World&);
/// The world's objects in their colours, in order of height, hot ones with a glow.
void drawObjects(DrawingSurface&, const World&);
/// A disc with a mark in the direction of its heading; all in pixels.
void drawRobot(DrawingSurface&, const mrpt::math::TPoint2D& center, double radius_px, const mrpt::math::TPoint2D& ahead,
               const Color&);
/// A scale bar of a round length, starting at `from` [px], with its number of metres. @return its length [px]
double drawScale(DrawingSurface&, const mrpt::math::TPoint2D& from, double text_px = kTextSize_px);
/// Width of that bar with its number [px].
double scaleWidth(const DrawingSurface&, double text_px);
///@}

/// Places labels beside objects so that they overlap neither each other nor reserved areas.
class NameWriter {
 public:
  explicit NameWriter(DrawingSurface& surface, double text_px = kTextSize_px) : surface_(surface), text_px_(text_px) {}

  void keepClear(const mrpt::math::TPoint2D& center, double half_width_px, double half_height_px);
  /// Writes a label at the free position beside an object that has the lowest contrast; omits it if there is none.
  void write(const std::string& name, const mrpt::math::TPoint2D& center, double half_width_px, double half_height_px,
             const Color&);
  /// The name of each hot object.
  void writeHotObjects(const World&);

 private:
  DrawingSurface& surface_;
  double text_px_;               ///< height of a capital
  std::vector<Bounds2D> taken_;  ///< rectangles of pixels
};

}  // namespace robosim
