#include "geometry/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/level_ray.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The stretch of a line, by its parameter; empty when from > to.
struct Stretch {
  double from = -kInfinity;
  double to = kInfinity;

  /// Also when the stretch has no end yet: infinity is not beyond infinity.
  void makeEmpty() { *this = {kInfinity, -kInfinity}; }
  void clip(double other_from, double other_to) {
    from = std::max(from, other_from);
    to = std::min(to, other_to);
  }
  /// Keeps where origin + t·direction lies within [low, high].
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

void clipToOutline(Stretch& stretch, const Ray& ray, const Circle& circle) {
  const TPoint2D out(ray.origin.x - circle.center.x, ray.origin.y - circle.center.y);
  const TPoint2D d(ray.direction.x, ray.direction.y);
  const double dd = d.x * d.x + d.y * d.y;
  const double rr = circle.radius_m * circle.radius_m;
  if (dd == 0) {  // straight up or down
    if (out.x * out.x + out.y * out.y > rr) stretch.makeEmpty();
    return;
  }
  // From the foot of the centre on the line: more exact for far circles than the textbook's b² - 4ac.
  const double mid = -(out.x * d.x + out.y * d.y) / dd;
  const TPoint2D foot(out.x + mid * d.x, out.y + mid * d.y);
  const double left = rr - (foot.x * foot.x + foot.y * foot.y);
  if (left < 0) {
    stretch.makeEmpty();
    return;
  }
  const double half = std::sqrt(left / dd);
  stretch.clip(mid - half, mid + half);
}

void clipToOutline(Stretch& stretch, const Ray& ray, const OrientedBox& box) {
  const double x = ray.origin.x - box.center.x;
  const double y = ray.origin.y - box.center.y;
  const TPoint2D& u = box.axis;
  stretch.clipSlab(x * u.x + y * u.y, ray.direction.x * u.x + ray.direction.y * u.y, -box.half_length_m,
                   box.half_length_m);
  stretch.clipSlab(y * u.x - x * u.y, ray.direction.y * u.x - ray.direction.x * u.y, -box.half_width_m,
                   box.half_width_m);
}

std::optional<double> intersectLevel(const Ray& ray, const Solid& solid) {
  if (!solid.heights.contains(ray.origin.z)) return std::nullopt;
  const TPoint2D origin(ray.origin.x, ray.origin.y);
  double distance_m = kInfinity;
  if (const auto* circle = std::get_if<Circle>(&solid.outline)) {
    const TPoint2D out = circle->center - origin;
    distance_m = enterCircle(out.x, out.y, ray.direction.x, ray.direction.y, circle->radius_m);
  } else {
    const auto& box = std::get<OrientedBox>(solid.outline);
    const TPoint2D out = box.center - origin;
    distance_m = enterBox(out.x, out.y, ray.direction.x, ray.direction.y, box.axis.x, box.axis.y, box.half_length_m,
                          box.half_width_m);
  }
  return distance_m < kInfinity ? std::optional(distance_m) : std::nullopt;
}

}  // namespace

Ray Ray::towards(const mrpt::math::TPoint3D& origin, double azimuth_rad, double elevation_rad) {
  const double level = elevation_rad == 0 ? 1 : std::cos(elevation_rad);
  const double up = elevation_rad == 0 ? 0 : std::sin(elevation_rad);
  return {origin, {level * std::cos(azimuth_rad), level * std::sin(azimuth_rad), up}};
}

std::optional<double> intersect(const Ray& ray, const Solid& solid) {
  if (ray.direction.z == 0) return intersectLevel(ray, solid);
  Stretch stretch{0, kInfinity};
  stretch.clipSlab(ray.origin.z, ray.direction.z, solid.heights.z_min_m, solid.heights.z_max_m);
  if (stretch.from > stretch.to) return std::nullopt;
  std::visit([&](const auto& outline) { clipToOutline(stretch, ray, outline); }, solid.outline);
  if (stretch.from > stretch.to) return std::nullopt;
  return stretch.from;
}

}  // namespace robosim
