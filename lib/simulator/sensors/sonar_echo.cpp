#include "sensors/sonar_echo.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

/// Two surfaces are a corner when their normals are within 5° of a right angle.
constexpr double kCornerCosine = 0.0872;

double dotInPlan(const TPoint3D& a, const TPoint2D& b) { return a.x * b.x + a.y * b.y; }

SonarTarget targetAt(const Outline& outline, const TPoint2D& from) {
  const auto* box = std::get_if<OrientedBox>(&outline);
  if (!box) return SonarTarget::edge;
  const TPoint2D d = from - box->center;
  const bool is_beside = std::abs(d.x * box->axis.x + d.y * box->axis.y) > box->half_length_m &&
                         std::abs(d.y * box->axis.x - d.x * box->axis.y) > box->half_width_m;
  return is_beside ? SonarTarget::edge : SonarTarget::face;
}

}  // namespace

SonarReflector::SonarReflector(const SonarNoise& noise, double range_max_m)
    : noise_(noise), range_max_m_(range_max_m), specular_cosine_(portable::cos(noise.specular_rad)) {
  for (const auto target : {SonarTarget::face, SonarTarget::edge}) {
    const double near_rad = noise.lobe.angleAt(0, target), far_rad = noise.lobe.angleAt(noise.lobe.range_m, target);
    always_[static_cast<std::size_t>(target)] = portable::cos(std::min(near_rad, far_rad));
    ever_[static_cast<std::size_t>(target)] = portable::cos(std::max(near_rad, far_rad));
  }
}

bool SonarReflector::covers(double ahead, double range_m, SonarTarget target) const {
  if (ahead >= always_[static_cast<std::size_t>(target)]) return true;
  if (ahead < ever_[static_cast<std::size_t>(target)]) return false;
  return ahead >= portable::cos(noise_.lobe.angleAt(range_m, target));
}

std::optional<SonarEcho> SonarReflector::direct(const Scene& scene, BodyId owner, const Ray& axis, const SonarEcho& met,
                                                BodyId body) const {
  if (met.range_m <= 0) return met;
  const Solid solid = scene.solid(body);
  if (!noise_.lobe.on) {
    const double flat = portable::hypot(met.direction.x, met.direction.y);
    const double facing = -dotInPlan(met.direction, normalAt(solid.outline, {met.point.x, met.point.y})) / flat;
    return facing < specular_cosine_ ? std::nullopt : std::optional(met);
  }
  const TPoint2D from(axis.origin.x, axis.origin.y);
  // A body above or below the sonar has an edge at its height, where the ping met it.
  if (!solid.heights.contains(axis.origin.z)) {
    const double ahead =
        met.direction.x * axis.direction.x + met.direction.y * axis.direction.y + met.direction.z * axis.direction.z;
    return covers(ahead, met.range_m, SonarTarget::edge) ? std::optional(met) : std::nullopt;
  }
  const TPoint2D out = nearestPoint(solid.outline, from) - from;
  const double range_m = portable::hypot(out.x, out.y);
  if (range_m == 0) return met;
  const double ahead = dotInPlan(axis.direction, out) / range_m;
  if (!covers(ahead, range_m, targetAt(solid.outline, from))) return std::nullopt;
  const TPoint3D direction{out.x / range_m, out.y / range_m, 0};
  const SonarEcho echo{range_m, direction, axis.origin + direction * range_m};
  if (echo.direction.x * met.direction.x + echo.direction.y * met.direction.y > 1 - 1e-9) return echo;
  // The nearest point is not where the ping met the body, and may be hidden.
  const Hit hit = scene.castRay({axis.origin, echo.direction}, range_m + kContactGap_m, owner);
  return hit && hit.body != body ? std::nullopt : std::optional(echo);
}

bool SonarReflector::faces(const TPoint3D& direction, const TPoint2D& normal, double range_m) const {
  const double facing = -dotInPlan(direction, normal);
  return noise_.lobe.on ? covers(facing, range_m, SonarTarget::face) : facing >= specular_cosine_;
}

std::optional<SonarEcho> SonarReflector::fromCorner(const Ray& axis, const TPoint3D& at, const TPoint2D& normal,
                                                    const TPoint3D& next_at, const TPoint2D& next) const {
  // The apex lies on both faces.
  const double c = dotInPlan(at, normal), d = dotInPlan(next_at, next);
  const double determinant = normal.x * next.y - normal.y * next.x;
  const TPoint3D apex{(c * next.y - d * normal.y) / determinant, (d * normal.x - c * next.x) / determinant, at.z};
  const TPoint2D out(apex.x - axis.origin.x, apex.y - axis.origin.y);
  const double range_m = portable::hypot(out.x, out.y);
  if (range_m == 0) return std::nullopt;
  const TPoint3D direction{out.x / range_m, out.y / range_m, 0};
  const double ahead = direction.x * axis.direction.x + direction.y * axis.direction.y;
  if (noise_.lobe.on && !covers(ahead, range_m, SonarTarget::face)) return std::nullopt;
  return SonarEcho{range_m, direction, apex};
}

std::optional<SonarEcho> SonarReflector::second(const Scene& scene, BodyId owner, const Ray& axis, const SonarEcho& met,
                                                BodyId body) const {
  const TPoint3D& at = met.point;
  const TPoint2D normal = normalAt(scene.solid(body).outline, {at.x, at.y});
  const double into = dotInPlan(met.direction, normal);
  if (into >= 0 || met.range_m >= range_max_m_) return std::nullopt;
  const TPoint3D away{met.direction.x - 2 * into * normal.x, met.direction.y - 2 * into * normal.y, met.direction.z};
  const TPoint3D start{at.x + kContactGap_m * normal.x, at.y + kContactGap_m * normal.y, at.z};
  const Hit hit = scene.castRay({start, away}, range_max_m_ - met.range_m, owner);
  if (!hit || hit.distance_m <= 0) return std::nullopt;
  const TPoint2D next = normalAt(scene.solid(hit.body).outline, {hit.point.x, hit.point.y});
  const double way_m = met.range_m + hit.distance_m;
  if (std::abs(normal.x * next.x + normal.y * next.y) < kCornerCosine)
    return fromCorner(axis, at, normal, hit.point, next);
  if (faces(away, next, way_m)) return SonarEcho{way_m, met.direction, hit.point};
  return std::nullopt;
}

}  // namespace robosim
