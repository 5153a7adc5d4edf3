#pragma once
#include <functional>
#include <optional>
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
inline constexpr double kLineHeight = 1.7;  ///< of a text with accents and descenders, in capitals

/// By robot: the colour of its body, as in 3D (robots/robot_colors.h).
std::vector<Color> robotColors(const Fleet&);

/// Spacing of grid lines [m], a round number.
double gridStep(const GroundView&);
/// The ground within the world's bounds, with a grid.
void drawFloor(DrawingSurface&, const Bounds2D& bounds);
/// What is painted on it: the maps without height, and the objects that are not above it.
void drawFloorAreas(DrawingSurface&, const World&, const std::vector<WorldObject>& objects);
/// The walls of the world's maps.
void drawMaps(DrawingSurface&, const World&);
/// Objects above the floor in their colours, in order of height, hot ones and lights with a glow.
void drawObjects(DrawingSurface&, const std::vector<WorldObject>& objects);
/// A disc with a mark in the direction of its heading; all in pixels.
void drawRobot(DrawingSurface&, const mrpt::math::TPoint2D& center, double radius_px, const mrpt::math::TPoint2D& ahead,
               const Color&);
/// A disc that is small, as for one of many robots, with a short line in the direction of its heading if it is not
/// tiny; a robot that is large enough is drawn as by drawRobot().
void drawRobotOfMany(DrawingSurface&, const mrpt::math::TPoint2D& center, double radius_px,
                     const mrpt::math::TPoint2D& ahead, const Color&);
/// A scale bar of a round length, starting at `from` [px], with its number of metres. @return its length [px]
double drawScale(DrawingSurface&, const mrpt::math::TPoint2D& from, double text_px = kTextSize_px);
/// Width of that bar with its number [px].
/// @param width_of returns the width of a text of this size
double scaleWidth(const GroundView&, double text_px, const std::function<double(const std::string& text)>& width_of);
///@}

/// Places labels beside objects so that they overlap neither each other nor reserved areas.
class NameWriter {
 public:
  /// Labels of a moving picture, which are omitted where there is no room beside an object.
  explicit NameWriter(DrawingSurface& surface, double text_px = kTextSize_px);
  /// Labels of a figure: those without room beside an object are farther away, joined to it by a line.
  /// @param within rectangle of pixels that contains all labels
  NameWriter(DrawingSurface& surface, double text_px, const Bounds2D& within);

  void keepClear(const mrpt::math::TPoint2D& center, double half_width_px, double half_height_px);
  /// Writes a label at the free position beside an object that has the lowest contrast; omits it if there is none.
  void write(const std::string& name, const mrpt::math::TPoint2D& center, double half_width_px, double half_height_px,
             const Color&);
  /// The name of each hot object.
  void writeHotObjects(const std::vector<WorldObject>& objects);

 private:
  bool isFree(const Bounds2D& place) const;
  void writeAt(const Bounds2D& place, const std::string& name, const Color&);
  void writeWithLeader(const std::string& name, const mrpt::math::TPoint2D& center,
                       const mrpt::math::TPoint2D& half_object, const mrpt::math::TPoint2D& half_label, const Color&);

  DrawingSurface& surface_;
  double text_px_;            ///< height of a capital
  Bounds2D within_;           ///< rectangle of pixels
  bool has_leaders_ = false;  ///< lines to labels that are not beside their object
  /// @name Rectangles of pixels
  ///@{
  std::vector<Bounds2D> objects_;  ///< reserved areas
  std::vector<Bounds2D> labels_;   ///< also leaders
  ///@}
};

}  // namespace robosim
