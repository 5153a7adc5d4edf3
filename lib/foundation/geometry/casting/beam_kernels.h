#pragma once
#include <cmath>
#include <cstddef>

#include "geometry/index/grid_item.h"
#include "geometry/shapes/ray_intersection.h"

/// Intersection of one beam with one solid, free of branches and always inlined, so that the loops over beams are
/// vectorised. Each keeps the result if it is nearer than the beam's current hit, or equally near with a lower body, so
/// that the result does not depend on the order of solids.
namespace robosim {

/// Number of beams that are intersected with a solid together: few keep the beams of a sonar ring apart, many fill the
/// widest vectors.
///@{
constexpr std::size_t kNarrowBlock = 4;
constexpr std::size_t kWideBlock = 8;
///@}

/// Rays of a batch as restrict pointers, which the loops below need to be vectorised.
struct RayBeams {
  const double* __restrict x;
  const double* __restrict y;
  const double* __restrict left_x;
  const double* __restrict left_y;
  double* __restrict distance;
  double* __restrict body;

  /// @param fields BeamBatch::Field, each of `padded` numbers
  RayBeams(double* fields, std::size_t padded)
      : x(fields),
        y(fields + padded),
        left_x(fields + 2 * padded),
        left_y(fields + 3 * padded),
        distance(fields + 6 * padded),
        body(fields + 7 * padded) {}
};

/// The same of sectors.
struct SectorBeams : RayBeams {
  const double* __restrict right_x;
  const double* __restrict right_y;
  double* __restrict towards_x;
  double* __restrict towards_y;

  SectorBeams(double* fields, std::size_t padded)
      : RayBeams(fields, padded),
        right_x(fields + 4 * padded),
        right_y(fields + 5 * padded),
        towards_x(fields + 8 * padded),
        towards_y(fields + 9 * padded) {}
};

/// Whether a hit at `t` is nearer than that of beam i, or equally near with a lower body.
[[gnu::always_inline]] inline bool isBetter(const RayBeams& beams, std::size_t i, double t, double body) {
  return (t < beams.distance[i]) | ((t == beams.distance[i]) & (body < beams.body[i]));
}

[[gnu::always_inline]] inline void keepRay(const RayBeams& beams, std::size_t i, double t, double body) {
  const bool better = isBetter(beams, i, t, body);
  beams.distance[i] = better ? t : beams.distance[i];
  beams.body[i] = better ? body : beams.body[i];
}

/// Keeps the nearest point of a solid in sector i: the nearest point of its outline to the apex, or a point where an
/// edge of the sector enters it, as nearestInSector() does.
/// @param near distance of the outline's nearest point, which lies at (near_x, near_y) from the apex
[[gnu::always_inline]] inline void keepSector(const SectorBeams& s, std::size_t i, double near, double near_x,
                                              double near_y, double on_left, double on_right, double body) {
  const bool is_inside =
      (s.right_x[i] * near_y - s.right_y[i] * near_x >= 0) & (near_x * s.left_y[i] - near_y * s.left_x[i] >= 0);
  // Of equally near edge points the left one wins, as in nearestInSector().
  const bool left_first = on_left <= on_right;
  const double on_edge = left_first ? on_left : on_right;
  const double edge_x = left_first ? s.left_x[i] : s.right_x[i];
  const double edge_y = left_first ? s.left_y[i] : s.right_y[i];
  const double t = is_inside ? near : on_edge;
  const double to_x = is_inside ? near_x : edge_x * on_edge;
  const double to_y = is_inside ? near_y : edge_y * on_edge;
  const bool better = isBetter(s, i, t, body);
  s.distance[i] = better ? t : s.distance[i];
  s.body[i] = better ? body : s.body[i];
  s.towards_x[i] = better ? to_x : s.towards_x[i];
  s.towards_y[i] = better ? to_y : s.towards_y[i];
}

/// A ray is stored as a sector with its direction as the left edge.
struct RayKernel {
  using Beams = RayBeams;

  [[gnu::always_inline]] static void circle(const Beams& rays, std::size_t i, const GridItem& s, double body) {
    keepRay(rays, i, intersectCircle(s.x - rays.x[i], s.y - rays.y[i], rays.left_x[i], rays.left_y[i], s.half_length_m),
            body);
  }
  [[gnu::always_inline]] static void box(const Beams& rays, std::size_t i, const GridItem& s, double body) {
    keepRay(rays, i,
            intersectBox(s.x - rays.x[i], s.y - rays.y[i], rays.left_x[i], rays.left_y[i], s.axis_x, s.axis_y,
                         s.half_length_m, s.half_width_m),
            body);
  }
};

/// As nearestInSector().
struct SectorKernel {
  using Beams = SectorBeams;

  [[gnu::always_inline]] static void circle(const Beams& s, std::size_t i, const GridItem& circle, double body) {
    const double ox = circle.x - s.x[i];
    const double oy = circle.y - s.y[i];
    const double radius = circle.half_length_m;
    const double far = std::sqrt(ox * ox + oy * oy);
    const bool inside = far <= radius;
    const double near = inside ? 0.0 : far - radius;
    const double share = inside ? 0.0 : near / far;
    keepSector(s, i, near, ox * share, oy * share, intersectCircle(ox, oy, s.left_x[i], s.left_y[i], radius),
               intersectCircle(ox, oy, s.right_x[i], s.right_y[i], radius), body);
  }
  [[gnu::always_inline]] static void box(const Beams& s, std::size_t i, const GridItem& box, double body) {
    const double ox = box.x - s.x[i];
    const double oy = box.y - s.y[i];
    const double ux = box.axis_x;
    const double uy = box.axis_y;
    const double half_length = box.half_length_m;
    const double half_width = box.half_width_m;
    // The apex in the box's frame, and the vector to the box's nearest point.
    const double a = -(ox * ux + oy * uy);
    const double b = -(oy * ux - ox * uy);
    const double in_a = a < -half_length ? -half_length : (a > half_length ? half_length : a);
    const double in_b = b < -half_width ? -half_width : (b > half_width ? half_width : b);
    const double to_a = in_a - a;
    const double to_b = in_b - b;
    const double near_x = to_a * ux - to_b * uy;
    const double near_y = to_a * uy + to_b * ux;
    keepSector(s, i, std::sqrt(near_x * near_x + near_y * near_y), near_x, near_y,
               intersectBox(ox, oy, s.left_x[i], s.left_y[i], ux, uy, half_length, half_width),
               intersectBox(ox, oy, s.right_x[i], s.right_y[i], ux, uy, half_length, half_width), body);
  }
};

}  // namespace robosim
