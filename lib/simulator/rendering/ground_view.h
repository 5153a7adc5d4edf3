#pragma once
#include <mrpt/math/TPoint2D.h>

#include "geometry/shapes/solid.h"

namespace robosim {

/// Transform between the world frame and a picture from straight above: uniform scale, x to the right, y up.
class GroundView {
 public:
  GroundView() = default;
  /// @param width_px, height_px of the picture, >= 1
  /// @param center world frame, in the middle of the picture
  GroundView(int width_px, int height_px, const mrpt::math::TPoint2D& center, double px_per_m)
      : px_per_m_(px_per_m),
        at_zero_{center.x - (width_px - 1) / 2.0 / px_per_m, center.y + (height_px - 1) / 2.0 / px_per_m},
        width_px_(width_px),
        height_px_(height_px) {}

  int width() const { return width_px_; }
  int height() const { return height_px_; }
  double pixelsPerMetre() const { return px_per_m_; }
  /// World frame [m] to pixels: x to the right, y down, (0, 0) in the middle of the upper left pixel.
  mrpt::math::TPoint2D toPixel(const mrpt::math::TPoint2D& world) const {
    return {(world.x - at_zero_.x) * px_per_m_, (at_zero_.y - world.y) * px_per_m_};
  }
  mrpt::math::TPoint2D toWorld(const mrpt::math::TPoint2D& pixel) const {
    return {at_zero_.x + pixel.x / px_per_m_, at_zero_.y - pixel.y / px_per_m_};
  }
  /// The part of the world that the picture covers, world frame.
  Bounds2D visibleArea() const {
    const auto low = toWorld({-0.5, height_px_ - 0.5});
    const auto high = toWorld({width_px_ - 0.5, -0.5});
    return {low.x, high.x, low.y, high.y};
  }
  bool operator==(const GroundView&) const = default;

 private:
  double px_per_m_ = 1;
  mrpt::math::TPoint2D at_zero_;  ///< world coordinates of the centre of pixel (0, 0)
  int width_px_ = 1, height_px_ = 1;
};

/// The largest of 1, 2, 5, 10, 20, … and of 0.5, 0.2, 0.1, … that is not above `limit`, which is > 0.
double roundLengthUpTo(double limit);

}  // namespace robosim
