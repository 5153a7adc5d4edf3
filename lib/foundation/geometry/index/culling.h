#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <mrpt/math/TPoint2D.h>

#include "base/quads.h"
#include "geometry/index/grid_item.h"

/// Conservative culling in single precision: tests that select candidate solids without false negatives.
namespace robosim {

/// Bound of the relative error of the culling arithmetic: rounding to float has a relative error of at most 6e-8, and a
/// few sums and products of such numbers stay well below this fraction of the largest length involved.
constexpr double kCullRelativeError = 2e-6;

/// Disc that covers a solid, in single precision for conservative culling, relative to the middle of its scene. The
/// radius includes the rounding error, so culling has no false negatives.
struct CullDisc {
  float x = 0, y = 0, radius_m = 0;

  static CullDisc from(const GridItem& item, const mrpt::math::TPoint2D& middle) {
    constexpr double kSlack_m = 1e-9;  // more than the rounding error of these lengths in double precision
    const double x = item.x - middle.x;
    const double y = item.y - middle.y;
    const double rounding_m = kCullRelativeError * (std::abs(x) + std::abs(y) + item.reach()) + kSlack_m;
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(item.reach() + rounding_m)};
  }
};

/// A disc with the index of its solid: 16 bytes.
struct IndexedDisc {
  CullDisc disc;
  std::uint32_t index = 0;
};

/// Four discs, transposed in registers.
struct FourCullDiscs {
  FloatQuad x, y, radius_m;

  explicit FourCullDiscs(const IndexedDisc* four) {
    static_assert(sizeof *four == sizeof(FloatQuad));
    FloatQuad row[4];
    for (std::size_t i = 0; i < 4; ++i) std::memcpy(&row[i], four + i, sizeof row[i]);
    const auto low_01 = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
    const auto low_23 = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
    const auto high_01 = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
    const auto high_23 = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
    x = __builtin_shufflevector(low_01, low_23, 0, 1, 4, 5);
    y = __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7);
    radius_m = __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5);
  }
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

/// Half-plane ahead of a point, extended backwards by `margin_m`.
struct HalfPlaneCull {
  mrpt::math::TPoint2D origin;
  mrpt::math::TPoint2D facing;  ///< unit vector; (0, 0) accepts everything
  double margin_m = 0;

  bool isEverything() const { return facing.x == 0 && facing.y == 0; }
  /// Whether a solid reaches into the half-plane. Conservative: no false negatives.
  bool mayContain(const GridItem& item) const {
    const double ahead_m = facing.x * (item.x - origin.x) + facing.y * (item.y - origin.y);
    return ahead_m >= -(item.half_length_m + item.half_width_m + margin_m);
  }
};

/// Tests solids against the part of a disc that lies in a half-plane, in single precision. Conservative: no false
/// negatives.
class RangeCull {
 public:
  /// @param half_plane its origin is the disc's centre  @param reach_m at least 0
  RangeCull(const HalfPlaneCull& half_plane, double reach_m, const mrpt::math::TPoint2D& middle)
      : at_(half_plane.origin),
        reach_m_(std::min(reach_m, double{std::numeric_limits<float>::max()})),
        facing_x_(inEachLane(static_cast<float>(half_plane.facing.x))),
        facing_y_(inEachLane(static_cast<float>(half_plane.facing.y))) {
    const CullPoint place = CullPoint::from(at_, reach_m_ + half_plane.margin_m, middle);
    x_ = inEachLane(place.x);
    y_ = inEachLane(place.y);
    far_m_ = inEachLane(static_cast<float>(reach_m_) + place.rounding_m);
    margin_m_ = inEachLane(static_cast<float>(half_plane.margin_m) + place.rounding_m);
  }

  Bounds2D bounds() const { return {at_.x - reach_m_, at_.x + reach_m_, at_.y - reach_m_, at_.y + reach_m_}; }
  /// One bit per solid.
  std::uint32_t mayContain(const FourCullDiscs& solids) const {
    const FloatQuad dx = solids.x - x_;
    const FloatQuad dy = solids.y - y_;
    const FloatQuad far_m = solids.radius_m + far_m_;
    const FloatQuad back_m = solids.radius_m + margin_m_;
    return signsOf((dx * dx + dy * dy <= far_m * far_m) & (facing_x_ * dx + facing_y_ * dy >= -back_m));
  }

 private:
  mrpt::math::TPoint2D at_;
  double reach_m_;
  FloatQuad x_, y_, far_m_, facing_x_, facing_y_, margin_m_;
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
