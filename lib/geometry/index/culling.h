#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include <mrpt/math/TPoint2D.h>

#include "geometry/index/grid_item.h"

/// Conservative culling in single precision: tests that select candidate solids without false negatives.
namespace robosim {

/// Bound of the relative error of the culling arithmetic: rounding to float has a relative error of at most 6e-8, and a
/// few sums and products of such numbers stay well below this fraction of the largest length involved.
constexpr double kCullRelativeError = 2e-6;

/// Solid in single precision for conservative culling, relative to the middle of its scene. `round_m` includes the
/// rounding error, so culling has no false negatives.
struct CullSolid {
  float x = 0, y = 0, axis_x = 1, axis_y = 0;
  float half_length_m = 0, half_width_m = 0, round_m = 0;

  static CullSolid from(const GridItem&, const mrpt::math::TPoint2D& middle);
  /// Radius [m] of a covering disc about its centre.
  float reach() const { return half_length_m + half_width_m + round_m; }
};

/// Point in single precision for conservative culling.
struct CullPoint {
  float x = 0, y = 0;
  float rounding_m = 0;  ///< bound of the rounding error [m]

  /// @param spread_m distance from the point at which queries start
  static CullPoint from(const mrpt::math::TPoint2D& place, double spread_m, const mrpt::math::TPoint2D& middle) {
    const double x = place.x - middle.x;
    const double y = place.y - middle.y;
    return {static_cast<float>(x), static_cast<float>(y),
            static_cast<float>(kCullRelativeError * (std::abs(x) + std::abs(y) + spread_m))};
  }
};

/// Tests solids against a disc in single precision. Conservative: no false negatives.
class RangeCull {
 public:
  /// @param reach_m at least 0
  RangeCull(const mrpt::math::TPoint2D& place, double reach_m, const mrpt::math::TPoint2D& middle)
      : at_(place),
        reach_m_(std::min(reach_m, double{std::numeric_limits<float>::max()})),
        place_(CullPoint::from(place, reach_m_, middle)),
        far_m_(static_cast<float>(reach_m_) + place_.rounding_m) {}

  Bounds2D bounds() const { return {at_.x - reach_m_, at_.x + reach_m_, at_.y - reach_m_, at_.y + reach_m_}; }
  bool mayContain(const CullSolid& solid) const {
    const float dx = solid.x - place_.x;
    const float dy = solid.y - place_.y;
    const float far_m = far_m_ + solid.reach();
    return dx * dx + dy * dy <= far_m * far_m;
  }

 private:
  mrpt::math::TPoint2D at_;
  double reach_m_;
  CullPoint place_;
  float far_m_;
};

/// Half-plane ahead of a point, extended backwards by `margin_m`.
struct HalfPlaneCull {
  mrpt::math::TPoint2D origin;
  mrpt::math::TPoint2D facing;  ///< unit vector; (0, 0) accepts everything
  double margin_m = 0;
};

/// Tests the cells of a grid against a half-plane. Conservative: no false negatives.
class CellHalfPlaneCull {
 public:
  /// @param low the grid's lower left corner
  CellHalfPlaneCull(const HalfPlaneCull& half_plane, const mrpt::math::TPoint2D& low, double cell_m)
      : per_column_m_(half_plane.facing.x * cell_m), per_row_m_(half_plane.facing.y * cell_m) {
    const double low_m =
        half_plane.facing.x * (low.x - half_plane.origin.x) + half_plane.facing.y * (low.y - half_plane.origin.y);
    first_m_ = low_m + (per_column_m_ + per_row_m_) / 2 + (std::abs(per_column_m_) + std::abs(per_row_m_)) / 2 +
               half_plane.margin_m + kSlack_m;
  }

  bool mayContain(int column, int row) const { return first_m_ + column * per_column_m_ + row * per_row_m_ >= 0; }

 private:
  static constexpr double kSlack_m = 1e-6;  ///< exceeds the rounding error

  double per_column_m_, per_row_m_;  ///< forward offset of the next column or row [m]
  double first_m_;                   ///< forward distance of the first cell's foremost corner, plus the margins
};

}  // namespace robosim
