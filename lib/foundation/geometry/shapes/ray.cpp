#include "geometry/shapes/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable_math.h"
#include "geometry/shapes/ray_intersection.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Interval of a line parameter; empty when from > to.
struct Interval {
  double from = -kInfinity;
  double to = kInfinity;

  /// Also correct for an unbounded interval, where from == to == infinity would not be empty.
  void makeEmpty() { *this = {kInfinity, -kInfinity}; }
  void clip(double other_from, double other_to) {
    from = std::max(from, other_from);
    to = std::min(to, other_to);
  }
  /// Clips to where origin + t·direction lies in [low, high].
  void clipSlab(double origin, double direction, double low, double high) {
    if (direction == 0) {
      if (origin < low || origin > high) makeEmpty();
      return;
    }
    const double a = (low - origin) / direction;
    const double b = (high - origin) / direction;
    clip(std::min(a, b), std::max(a, b));
  }
};

void clipToOutline(Interval& interval, const Ray& ray, const Circle& circle) {
  const TPoint2D out(ray.origin.x - circle.center.x, ray.origin.y - circle.center.y);
  const TPoint2D d(ray.direction.x, ray.direction.y);
  const double dd = d.x * d.x + d.y * d.y;
  const double rr = circle.radius_m * circle.radius_m;
  if (dd == 0) {  // vertical
    if (out.x * out.x + out.y * out.y > rr) interval.makeEmpty();
    return;
  }
  // Computed from the foot of the perpendicular from the centre: more accurate for far circles than the textbook's b² -
  // 4ac.
  const double mid = -(out.x * d.x + out.y * d.y) / dd;
  const TPoint2D foot(out.x + mid * d.x, out.y + mid * d.y);
  const double left = rr - (foot.x * foot.x + foot.y * foot.y);
  if (left < 0) {
    interval.makeEmpty();
    return;
  }
  const double half = std::sqrt(left / dd);
  interval.clip(mid - half, mid + half);
}

void clipToOutline(Interval& interval, const Ray& ray, const OrientedBox& box) {
  const double x = ray.origin.x - box.center.x;
  const double y = ray.origin.y - box.center.y;
  const TPoint2D& u = box.axis;
  interval.clipSlab(x * u.x + y * u.y, ray.direction.x * u.x + ray.direction.y * u.y, -box.half_length_m,
                    box.half_length_m);
  interval.clipSlab(y * u.x - x * u.y, ray.direction.y * u.x - ray.direction.x * u.y, -box.half_width_m,
                    box.half_width_m);
}

std::optional<double> intersectPlanar(const Ray& ray, const Solid& solid) {
  if (!solid.heights.contains(ray.origin.z)) return std::nullopt;
  const TPoint2D origin(ray.origin.x, ray.origin.y);
  double distance_m = kInfinity;
  if (const auto* circle = std::get_if<Circle>(&solid.outline)) {
    const TPoint2D out = circle->center - origin;
    distance_m = intersectCircle(out.x, out.y, ray.direction.x, ray.direction.y, circle->radius_m);
  } else {
    const auto& box = std::get<OrientedBox>(solid.outline);
    const TPoint2D out = box.center - origin;
    distance_m = intersectBox(out.x, out.y, ray.direction.x, ray.direction.y, box.axis.x, box.axis.y, box.half_length_m,
                              box.half_width_m);
  }
  return distance_m < kInfinity ? std::optional(distance_m) : std::nullopt;
}

}  // namespace

Ray Ray::towards(const mrpt::math::TPoint3D& origin, double azimuth_rad, double elevation_rad) {
  const auto [up, level] = portable::sincos(elevation_rad);
  const auto [sin, cos] = portable::sincos(azimuth_rad);
  return {origin, {level * cos, level * sin, up}};
}

std::optional<double> intersect(const Ray& ray, const Solid& solid) {
  if (ray.direction.z == 0) return intersectPlanar(ray, solid);
  Interval interval{0, kInfinity};
  interval.clipSlab(ray.origin.z, ray.direction.z, solid.heights.z_min_m, solid.heights.z_max_m);
  if (interval.from > interval.to) return std::nullopt;
  std::visit([&](const auto& outline) { clipToOutline(interval, ray, outline); }, solid.outline);
  if (interval.from > interval.to) return std::nullopt;
  return interval.from;
}

std::optional<RaySpan> spanInside(const Ray& ray, const Solid& solid) {
  Interval interval;
  interval.clipSlab(ray.origin.z, ray.direction.z, solid.heights.z_min_m, solid.heights.z_max_m);
  std::visit([&](const auto& outline) { clipToOutline(interval, ray, outline); }, solid.outline);
  if (interval.from > interval.to) return std::nullopt;
  return RaySpan{interval.from, interval.to};
}

}  // namespace robosim
