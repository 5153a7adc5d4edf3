#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/shapes/ray_intersection.h"
#include "sensors/raycast/seen_solids.h"

/// Ray casting of upright solids by columns: all rays of a column lie in one vertical plane, so that one intersection
/// of a solid's outline with the column serves all of its rays. A tile of columns that lie side by side is intersected
/// with the solids from front to back; each ray keeps the nearest surface (z-buffer). What stands on the floor hides
/// all that is behind it and lower, which the horizon of each column records.
///
/// Always inlined and without branches between columns, so that loops over them are vectorised in a function of
/// withVectors().
namespace robosim {

/// Columns of a tile.
constexpr std::size_t kLanes = 8;

/// Planar rays of a tile's columns, in the view's frame. Depths are multiples of the directions' lengths.
struct TileColumns {
  const double* __restrict dx;
  const double* __restrict dy;
  const double* __restrict dd;      ///< squared length of the direction
  const double* __restrict per_dd;  ///< its inverse
  /// Origins, relative to that of the view; unused unless the columns are moved.
  const double* __restrict x = nullptr;
  const double* __restrict y = nullptr;
};

/// Where a tile's columns enter and leave a solid's outline.
struct alignas(64) Crossing {
  double in[kLanes];    ///< depth, 0 from inside; infinity for a miss
  double out[kLanes];   ///< -1 for a miss
  double side[kLanes];  ///< of a box: 1 where its end is entered, 0 where its side; of a circle: cosine to the sun
};

/// @tparam kIsMoved whether the columns have origins of their own
/// @param sun_x,sun_y direction to the sun, in the view's frame
template <bool kIsMoved = false>
[[gnu::always_inline]] inline void crossCircle(const TileColumns& columns, const SeenSolid& s, double sun_x,
                                               double sun_y, Crossing& crossing) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double rr = s.half_length_m * s.half_length_m, per_r = 1 / s.half_length_m;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = kIsMoved ? s.x - columns.x[i] : s.x;
    const double y = kIsMoved ? s.y - columns.y[i] : s.y;
    const double dx = columns.dx[i], dy = columns.dy[i], per_dd = columns.per_dd[i];
    const double along = dx * x + dy * y;
    const double across = dx * y - dy * x;
    const double half = std::sqrt(rr * columns.dd[i] - across * across);  // NaN for a miss
    const double first = (along - half) * per_dd;
    const double last = (along + half) * per_dd;
    const double in = first > 0 ? first : 0.0;
    crossing.in[i] = last >= 0 ? in : kInfinity;
    crossing.out[i] = last >= 0 ? last : -1.0;
    crossing.side[i] = ((in * dx - x) * sun_x + (in * dy - y) * sun_y) * per_r;
  }
}

/// As intersectBox().
template <bool kIsMoved = false>
[[gnu::always_inline]] inline void crossBox(const TileColumns& columns, const SeenSolid& s, Crossing& crossing) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double ux = s.axis_x, uy = s.axis_y;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = kIsMoved ? s.x - columns.x[i] : s.x;
    const double y = kIsMoved ? s.y - columns.y[i] : s.y;
    const double a = -(x * ux + y * uy);
    const double b = -(y * ux - x * uy);
    const double dx = columns.dx[i], dy = columns.dy[i];
    const double slope_a = dx * ux + dy * uy;
    const double slope_b = dy * ux - dx * uy;
    const double per_a = 1 / (slope_a == 0 ? kMinFaceSlope : slope_a);
    const double per_b = 1 / (slope_b == 0 ? kMinFaceSlope : slope_b);
    const double a1 = (-s.half_length_m - a - kMinFaceGap_m) * per_a;
    const double a2 = (s.half_length_m - a + kMinFaceGap_m) * per_a;
    const double b1 = (-s.half_width_m - b - kMinFaceGap_m) * per_b;
    const double b2 = (s.half_width_m - b + kMinFaceGap_m) * per_b;
    const double a_from = a1 < a2 ? a1 : a2;
    const double b_from = b1 < b2 ? b1 : b2;
    const double a_to = a2 < a1 ? a1 : a2;
    const double b_to = b2 < b1 ? b1 : b2;
    const double from = a_from > b_from ? a_from : b_from;
    const double to = a_to < b_to ? a_to : b_to;
    const double in = from > 0 ? from : 0.0;
    crossing.in[i] = in <= to ? in : kInfinity;
    crossing.out[i] = in <= to ? to : -1.0;
    crossing.side[i] = a_from > b_from ? 1.0 : 0.0;
  }
}

/// Of each column: beyond `depth` nothing is visible at slopes up to `slope`.
struct alignas(64) Horizon {
  double slope[kLanes], depth[kLanes];
  double slope_min, depth_max;  ///< of all columns

  [[gnu::always_inline]] void reset() {
    for (std::size_t i = 0; i < kLanes; ++i) {
      slope[i] = -std::numeric_limits<double>::infinity();
      depth[i] = 0;
    }
    slope_min = -std::numeric_limits<double>::infinity();
    depth_max = 0;
  }
};

/// Smallest and largest of a tile's numbers.
///@{
[[gnu::always_inline]] inline double smallest(const double* of) {
  double lane[4];
  for (std::size_t i = 0; i < 4; ++i) lane[i] = of[i] < of[i + 4] ? of[i] : of[i + 4];
  return std::min(std::min(lane[0], lane[1]), std::min(lane[2], lane[3]));
}
[[gnu::always_inline]] inline double largest(const double* of) {
  double lane[4];
  for (std::size_t i = 0; i < 4; ++i) lane[i] = of[i] > of[i + 4] ? of[i] : of[i + 4];
  return std::max(std::max(lane[0], lane[1]), std::max(lane[2], lane[3]));
}
///@}

/// What is visible of a solid in the columns of a tile: a vertical face at depth `in` between the slopes `low` and
/// `high`; and its top if it is lower than the origin, or its underside if it is higher, from depth `in` to `out`.
struct alignas(64) VisibleSpan {
  double in[kLanes], out[kLanes];  ///< infinity and -1 where nothing is visible
  double low[kLanes], high[kLanes];
  double low_min, high_max;                 ///< of all columns
  double level_m;                           ///< height of its top or underside relative to the origin; 0 for neither
  double level_slope_min, level_slope_max;  ///< of the level surface
};

/// Clips a solid to the horizon and raises the horizon. @param floor_m height of the floor relative to the origin,
/// below 0, which solids may stand on; -infinity without a floor
/// @return whether anything may be visible
[[gnu::always_inline]] inline bool clipToHorizon(const SeenSolid& s, const Crossing& crossing, double floor_m,
                                                 Horizon& horizon, VisibleSpan& span) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double high_m = s.high_m;
  const double low_m = s.low_m > floor_m ? s.low_m : floor_m;
  const bool is_below = high_m<0, is_above = low_m> 0;
  const bool stands = s.low_m <= floor_m;
  double top_slope[kLanes];
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double in = crossing.in[i], out = crossing.out[i];
    const double per_in = 1 / (in > kMinFaceSlope ? in : kMinFaceSlope);  // finite, so that 0 m stay 0
    const double high = high_m * per_in;
    const double low = low_m * per_in;
    const double top = is_below ? high_m / out : high;
    const bool is_behind = in >= horizon.depth[i];
    const bool is_visible = (in < kInfinity) & !(is_behind & (top <= horizon.slope[i]));
    const double clipped = (is_behind & (horizon.slope[i] > low)) ? horizon.slope[i] : low;
    span.in[i] = is_visible ? in : kInfinity;
    span.out[i] = is_visible ? out : -1.0;
    span.high[i] = is_visible ? high : -kInfinity;
    span.low[i] = is_visible ? clipped : kInfinity;
    top_slope[i] = top;
  }
  const double out_max = largest(span.out);
  if (!(out_max >= 0)) return false;
  span.high_max = largest(span.high);
  span.low_min = smallest(span.low);
  span.level_m = is_below ? high_m : is_above ? low_m : 0;
  if (span.level_m != 0) {
    const double nearest = span.level_m / smallest(span.in);
    const double farthest = span.level_m / out_max;
    span.level_slope_min = std::min(nearest, farthest);
    span.level_slope_max = std::max(nearest, farthest);
  }
  if (stands) {
#pragma GCC unroll 1
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double depth = is_below ? crossing.out[i] : crossing.in[i];
      const bool is_higher = (crossing.in[i] < kInfinity) & (top_slope[i] > horizon.slope[i]);
      horizon.slope[i] = is_higher ? top_slope[i] : horizon.slope[i];
      horizon.depth[i] = is_higher ? depth : horizon.depth[i];
    }
    horizon.slope_min = smallest(horizon.slope);
    horizon.depth_max = largest(horizon.depth);
  }
  return true;
}

/// Whether a solid is certainly hidden in all columns of a tile.
[[gnu::always_inline]] inline bool isHidden(const SeenSolid& s, const Horizon& horizon) {
  // The largest slope at which it may be seen.
  return s.near_m >= horizon.depth_max && s.near_m > 0 && s.high_m <= horizon.slope_min * s.near_m &&
         (s.high_m >= 0 || horizon.slope_min >= 0);
}

}  // namespace robosim
