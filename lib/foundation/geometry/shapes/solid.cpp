#include "geometry/shapes/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/portable_math.h"
#include "geometry/shapes/planar_vector.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

TPoint2D across(const OrientedBox& box) { return {-box.axis.y, box.axis.x}; }

TPoint2D toBox(const OrientedBox& box, const TPoint2D& p) {
  const TPoint2D d = p - box.center;
  return {d.x * box.axis.x + d.y * box.axis.y, d.y * box.axis.x - d.x * box.axis.y};
}

TPoint2D fromBox(const OrientedBox& box, const TPoint2D& p) { return box.center + box.axis * p.x + across(box) * p.y; }

std::array<TPoint2D, 4> corners(const OrientedBox& box) {
  const TPoint2D along = box.axis * box.half_length_m;
  const TPoint2D aside = across(box) * box.half_width_m;
  return {box.center + along + aside, box.center - along + aside, box.center - along - aside,
          box.center + along - aside};
}

/// Half the length of the box's projection onto a line along the unit vector `direction`.
double halfProjection(const OrientedBox& box, const TPoint2D& direction) {
  return box.half_length_m * std::abs(dot(box.axis, direction)) +
         box.half_width_m * std::abs(dot(across(box), direction));
}

/// Separating axis test (Gottschalk, Lin & Manocha, "OBBTree", SIGGRAPH 1996): the interiors of two boxes intersect
/// exactly when their projections on all four face normals do.
bool interiorsIntersect(const OrientedBox& a, const OrientedBox& b) {
  const TPoint2D between = b.center - a.center;
  for (const auto& direction : {a.axis, across(a), b.axis, across(b)}) {
    if (std::abs(dot(between, direction)) >= halfProjection(a, direction) + halfProjection(b, direction)) return false;
  }
  return true;
}

bool interiorsIntersect(const Circle& a, const Circle& b) {
  return (a.center - b.center).norm() < a.radius_m + b.radius_m;
}
bool interiorsIntersect(const OrientedBox& a, const Circle& b) { return distance(a, b.center) < b.radius_m; }
bool interiorsIntersect(const Circle& a, const OrientedBox& b) { return interiorsIntersect(b, a); }

double between(const Circle& a, const Circle& b) {
  return std::max(0.0, (a.center - b.center).norm() - a.radius_m - b.radius_m);
}
double between(const OrientedBox& a, const Circle& b) { return std::max(0.0, distance(a, b.center) - b.radius_m); }
double between(const Circle& a, const OrientedBox& b) { return between(b, a); }
double between(const OrientedBox& a, const OrientedBox& b) {
  if (interiorsIntersect(a, b)) return 0;
  // The shortest distance of two disjoint convex polygons is at a corner of one of them.
  double min_distance = std::numeric_limits<double>::infinity();
  for (const auto& corner : corners(a)) min_distance = std::min(min_distance, distance(b, corner));
  for (const auto& corner : corners(b)) min_distance = std::min(min_distance, distance(a, corner));
  return min_distance;
}

}  // namespace

OrientedBox OrientedBox::from(const mrpt::math::TPose2D& world_from_box, double length_m, double width_m) {
  const auto [sin, cos] = portable::sincos(world_from_box.phi);
  return {{world_from_box.x, world_from_box.y}, {cos, sin}, length_m / 2, width_m / 2};
}

Bounds2D boundsOf(const Outline& outline) {
  double half_x = 0;
  double half_y = 0;
  TPoint2D center;
  if (const auto* circle = std::get_if<Circle>(&outline)) {
    center = circle->center;
    half_x = half_y = circle->radius_m;
  } else {
    const auto& box = std::get<OrientedBox>(outline);
    center = box.center;
    half_x = halfProjection(box, {1, 0});
    half_y = halfProjection(box, {0, 1});
  }
  return {center.x - half_x, center.x + half_x, center.y - half_y, center.y + half_y};
}

TPoint2D nearestPoint(const Outline& outline, const TPoint2D& p) {
  if (const auto* circle = std::get_if<Circle>(&outline)) {
    const TPoint2D out = p - circle->center;
    const double far = out.norm();
    return far <= circle->radius_m ? p : circle->center + out * (circle->radius_m / far);
  }
  const auto& box = std::get<OrientedBox>(outline);
  const TPoint2D in_box = toBox(box, p);
  const TPoint2D clamped(std::clamp(in_box.x, -box.half_length_m, box.half_length_m),
                         std::clamp(in_box.y, -box.half_width_m, box.half_width_m));
  return clamped.x == in_box.x && clamped.y == in_box.y ? p : fromBox(box, clamped);
}

double distance(const Outline& outline, const TPoint2D& p) {
  if (const auto* circle = std::get_if<Circle>(&outline)) {
    return std::max(0.0, (p - circle->center).norm() - circle->radius_m);
  }
  const auto& box = std::get<OrientedBox>(outline);
  const TPoint2D in_box = toBox(box, p);
  return portable::hypot(std::max(0.0, std::abs(in_box.x) - box.half_length_m),
                         std::max(0.0, std::abs(in_box.y) - box.half_width_m));
}

double distance(const Outline& a, const Outline& b) {
  return std::visit([](const auto& one, const auto& other) { return between(one, other); }, a, b);
}

TPoint2D normalAt(const Outline& outline, const TPoint2D& on_rim) {
  if (const auto* circle = std::get_if<Circle>(&outline)) {
    const TPoint2D out = on_rim - circle->center;
    return out * (1 / out.norm());
  }
  const auto& box = std::get<OrientedBox>(outline);
  const TPoint2D in_box = toBox(box, on_rim);
  const bool at_end = box.half_length_m - std::abs(in_box.x) < box.half_width_m - std::abs(in_box.y);
  return at_end ? box.axis * std::copysign(1.0, in_box.x) : across(box) * std::copysign(1.0, in_box.y);
}

bool overlap(const Solid& a, const Solid& b) {
  return a.heights.overlaps(b.heights) &&
         std::visit([](const auto& one, const auto& other) { return interiorsIntersect(one, other); }, a.outline,
                    b.outline);
}

}  // namespace robosim
