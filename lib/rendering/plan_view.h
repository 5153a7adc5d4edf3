#pragma once
#include <mrpt/math/TPoint2D.h>

#include "geometry/solid.h"

namespace robosim {

/// How a piece of ground, seen from straight above, lies on a picture: to scale, x to the right, y up, with margins for
/// a title above and a legend below. The longer side of the picture has kLongSide_px.
class PlanView {
 public:
  /// @param area what must be on the picture; a side of no length is shown as a narrow strip.
  explicit PlanView(const Bounds2D& area);

  const Bounds2D& area() const { return area_; }
  int width() const { return width_px_; }
  int height() const { return height_px_; }
  double pixelsPerMetre() const { return px_per_m_; }
  /// World frame [m] to pixels: x to the right, y down, (0, 0) in the middle of the upper left pixel.
  mrpt::math::TPoint2D toPixel(const mrpt::math::TPoint2D& world) const {
    return {left_px_ + (world.x - area_.x_min) * px_per_m_, top_px_ + (area_.y_max - world.y) * px_per_m_};
  }

  static constexpr int kLongSide_px = 1200;
  static constexpr int kShortSideMin_px = 440;  ///< room for the legend of a world like a corridor
  static constexpr int kSideMargin_px = 24;
  static constexpr int kTopMargin_px = 44;
  static constexpr int kBottomMargin_px = 56;

 private:
  Bounds2D area_;
  double px_per_m_ = 1;
  double left_px_ = 0, top_px_ = 0;  ///< where the area begins on the picture
  int width_px_ = 0, height_px_ = 0;
};

/// The largest of 1, 2, 5, 10, 20, … and of 0.5, 0.2, 0.1, … that is not above `limit`, which is > 0.
double roundLengthUpTo(double limit);

}  // namespace robosim
