#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/scene.h"

namespace robosim {

/// Frame of a picture or scan: its origin, and x along a horizontal direction of the sensor, y to the left.
struct ViewFrame {
  double x = 0, y = 0, z = 0;       ///< origin, world frame [m]
  double ahead_x = 1, ahead_y = 0;  ///< x axis, world frame; unit vector

  mrpt::math::TPoint2D toView(const mrpt::math::TPoint2D& direction) const {
    return {ahead_x * direction.x + ahead_y * direction.y, ahead_x * direction.y - ahead_y * direction.x};
  }
};

/// Part of the plane that a view covers: all directions, or those whose |y| is at most `slope_max` · x.
struct ViewWedge {
  double range_m = std::numeric_limits<double>::infinity();  ///< largest x; in all directions the largest distance
  double slope_max = std::numeric_limits<double>::infinity();
  double spread_m = 0;  ///< farthest origin of a ray from the view's

  bool isAround() const { return slope_max == std::numeric_limits<double>::infinity(); }
};

/// A solid that may be seen, in the frame of a view, heights relative to its origin.
struct SeenSolid {
  double x = 0, y = 0;
  double axis_x = 1, axis_y = 0;
  double half_length_m = 0, half_width_m = 0;  ///< as in FoundSolid
  double low_m = 0, high_m = 0;
  BodyId body = kNoBody;
  /// Lower bound of x of what is seen of it; in all directions of the distance.
  double near_m = 0;
  /// Bounds of y / x of its points; infinite if a part of it is not ahead. Unused in all directions.
  double slope_min = -std::numeric_limits<double>::infinity(), slope_max = std::numeric_limits<double>::infinity();

  bool isCircle() const { return half_width_m == 0; }
};

/// Replaces `seen` by the solids that may be seen, in ascending order of near_m; of equally near ones, of bodies.
void findSeenSolids(const Scene& scene, const ViewFrame& frame, const ViewWedge& wedge, BodyId owner,
                    std::vector<SeenSolid>& seen);

}  // namespace robosim
