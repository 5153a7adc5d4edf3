#include "robosim_bench/ray_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace robosim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Interval of a ray inside a shape; empty when from > to.
struct Stretch {
  double from, to;
  double entry() const { return from <= to && to >= 0 ? std::max(0.0, from) : kInfinity; }
};

/// The roots of |origin + t · direction - center|² = radius².
Stretch inside(const Circle& circle, double radius_m, const Ray& ray) {
  const double x = ray.origin.x - circle.center.x;
  const double y = ray.origin.y - circle.center.y;
  const double half_b = x * ray.direction.x + y * ray.direction.y;
  const double c = x * x + y * y - radius_m * radius_m;
  const double root = std::sqrt(half_b * half_b - c);  // NaN without a real root, which yields an empty interval
  return {-half_b - root, -half_b + root};
}

/// The interval between two parallel lines at -half and half, for an origin and a direction normal to them.
Stretch between(double half_m, double origin, double direction) {
  const double a = (-half_m - origin) / direction;
  const double b = (half_m - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

Stretch inside(const OrientedBox& box, double grown_m, const Ray& ray) {
  const double x = ray.origin.x - box.center.x;
  const double y = ray.origin.y - box.center.y;
  const auto& d = ray.direction;
  const Stretch along =
      between(box.half_length_m + grown_m, x * box.axis.x + y * box.axis.y, d.x * box.axis.x + d.y * box.axis.y);
  const Stretch across =
      between(box.half_width_m + grown_m, y * box.axis.x - x * box.axis.y, d.y * box.axis.x - d.x * box.axis.y);
  return {std::max(along.from, across.from), std::min(along.to, across.to)};
}

}  // namespace

RayTruth::RayTruth(std::span<const Solid> solids, std::vector<Ray> rays) : solids_(solids), rays_(std::move(rays)) {
  distance_m_.reserve(rays_.size());
  for (const auto& ray : rays_) distance_m_.push_back(cast(ray, 0));
}

double RayTruth::cast(const Ray& ray, double grown_m) const {
  double nearest_m = kInfinity;
  for (const auto& solid : solids_) {
    const auto* circle = std::get_if<Circle>(&solid.outline);
    const Stretch stretch = circle ? inside(*circle, circle->radius_m + grown_m, ray)
                                   : inside(std::get<OrientedBox>(solid.outline), grown_m, ray);
    nearest_m = std::min(nearest_m, stretch.entry());
  }
  return nearest_m;
}

bool RayTruth::agrees(std::size_t i, double distance_m, double range_m, double tolerance_m) const {
  const double true_m = std::min(distance_m_[i], range_m);
  const bool met = distance_m < range_m;
  const bool should_meet = distance_m_[i] < range_m;
  if (met == should_meet && std::abs(distance_m - true_m) <= tolerance_m) return true;
  const double nearest_m = std::min(cast(rays_[i], tolerance_m), range_m);
  const double farthest_m = std::min(cast(rays_[i], -tolerance_m), range_m);
  return distance_m >= nearest_m - tolerance_m && distance_m <= farthest_m + tolerance_m;
}

}  // namespace robosim
