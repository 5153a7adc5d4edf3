#pragma once
#include <variant>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

namespace robosim {

/// Heights from z_min_m to z_max_m, both included, in the world frame [m].
struct HeightSpan {
  double z_min_m = 0;
  double z_max_m = 0;

  bool contains(double z_m) const { return z_min_m <= z_m && z_m <= z_max_m; }
  /// Whether the two overlap by more than a common end.
  bool overlaps(const HeightSpan& other) const { return z_min_m < other.z_max_m && other.z_min_m < z_max_m; }
  bool operator==(const HeightSpan&) const = default;
};

/// A disc in plan, world frame [m].
struct Circle {
  mrpt::math::TPoint2D center;
  double radius_m = 0;  ///< > 0
};

/// An oriented rectangle in plan, world frame [m].
struct OrientedBox {
  mrpt::math::TPoint2D center;
  mrpt::math::TPoint2D axis{1, 0};  ///< unit vector along the length
  double half_length_m = 0;         ///< > 0, along `axis`
  double half_width_m = 0;          ///< > 0, across `axis`

  static OrientedBox from(const mrpt::math::TPose2D& world_from_box, double length_m, double width_m);
};

using Outline = std::variant<Circle, OrientedBox>;

/// An upright solid: an outline in plan, extruded over a span of heights.
struct Solid {
  Outline outline;
  HeightSpan heights;
};

/// Axis-aligned rectangle in plan [m].
struct Bounds2D {
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;

  bool contains(const mrpt::math::TPoint2D& p) const {
    return x_min <= p.x && p.x <= x_max && y_min <= p.y && p.y <= y_max;
  }
  bool covers(const Bounds2D& other) const {
    return contains({other.x_min, other.y_min}) && contains({other.x_max, other.y_max});
  }
  bool operator==(const Bounds2D&) const = default;
};

Bounds2D boundsOf(const Outline&);

/// The point of the filled outline nearest to `p`; `p` itself when it lies inside.
mrpt::math::TPoint2D nearestPoint(const Outline&, const mrpt::math::TPoint2D& p);
/// Distance [m] from `p` to the filled outline; 0 inside.
double distance(const Outline&, const mrpt::math::TPoint2D& p);
/// Distance [m] between two filled outlines, exact; 0 when they touch or overlap.
double distance(const Outline&, const Outline&);

/// Outward unit normal of the outline at a point of its boundary; at a corner, that of the nearer face.
mrpt::math::TPoint2D normalAt(const Outline&, const mrpt::math::TPoint2D& on_rim);

/// Whether the two solids overlap by more than a common face.
bool overlap(const Solid&, const Solid&);

}  // namespace robosim
