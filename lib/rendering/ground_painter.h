#pragma once
#include <string>
#include <vector>

#include "rendering/canvas.h"
#include "world/world.h"

namespace robosim {

/// @name What pictures from above have in common
///@{
inline constexpr Color kPageColor{0.922f, 0.941f, 0.961f};
inline constexpr Color kFloorColor{1, 1, 1};
inline constexpr Color kGridColor{0.882f, 0.902f, 0.922f};
inline constexpr Color kInkColor{0.16f, 0.18f, 0.22f};
inline constexpr Color kGlowColor{1.0f, 0.55f, 0.15f};
inline constexpr Color kWhite{1, 1, 1};
inline constexpr double kTextSize_px = 10;  ///< height of a capital

/// Colours that stay apart beside each other: eight well-known ones first, then hues in steps of the golden angle.
Color robotColor(std::size_t robot);

/// The ground within the world's bounds, with a grid of a round number of metres.
void drawFloor(Canvas&, const Bounds2D& bounds);
/// The world's objects in their colours, the lower ones first, hot ones with a glow.
void drawObjects(Canvas&, const World&);
/// A disc with a mark where it looks; all in pixels.
void drawRobot(Canvas&, const mrpt::math::TPoint2D& center, double radius_px, const mrpt::math::TPoint2D& ahead,
               const Color&);
/// A round length, from a place on [px], with its number of metres. @return its length [px]
double drawScale(Canvas&, const mrpt::math::TPoint2D& from);
///@}

/// Writes names beside things, where they cover neither each other nor what must stay to be seen.
class NameWriter {
 public:
  explicit NameWriter(Canvas& canvas) : canvas_(canvas) {}

  void keepClear(const mrpt::math::TPoint2D& center, double half_width_px, double half_height_px);
  /// Writes a name on the calmest of the free places beside a thing; nowhere if there is none.
  void write(const std::string& name, const mrpt::math::TPoint2D& center, double half_width_px, double half_height_px,
             const Color&);
  /// The name of each hot object.
  void writeHotObjects(const World&);

 private:
  Canvas& canvas_;
  std::vector<Bounds2D> taken_;  ///< rectangles of pixels
};

}  // namespace robosim
