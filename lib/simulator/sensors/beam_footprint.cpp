#include "sensors/beam_footprint.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"

namespace robosim {
namespace {

/// Surfaces that are nearer to each other [m] are the same for a scanner.
constexpr double kSameSurface_m = 0.02;
constexpr int kBisections = 6;

/// A ray turned by a small angle, to the left if positive.
Ray turned(const Ray& ray, double tangent) {
  const auto& d = ray.direction;
  const double scale = 1 / std::sqrt(1 + tangent * tangent);
  return {ray.origin, {scale * (d.x - tangent * d.y), scale * (d.y + tangent * d.x), d.z}};
}

}  // namespace

double BeamFootprint::power(const Ray& ray, double distance_m, BodyId body) {
  if (distance_m <= 0) return std::numeric_limits<double>::max();
  const mrpt::math::TPoint2D at(ray.origin.x + ray.direction.x * distance_m,
                                ray.origin.y + ray.direction.y * distance_m);
  if (body != lit_body_) {
    lit_body_ = body;
    lit_outline_ = now_.scene.solid(body).outline;
  }
  const auto normal = normalAt(lit_outline_, at);
  const double cosine = std::abs(ray.direction.x * normal.x + ray.direction.y * normal.y);
  const double reach = (errors_.reach_m > 0 ? errors_.reach_m : 1) / distance_m;
  return now_.reflectivityOf(body) * cosine * reach * reach;
}

int BeamFootprint::sideOfOther(const BeamHits& hits, std::size_t i) const {
  int side = 0;
  double largest_m = kSameSurface_m;
  for (const int to : {-1, 1}) {
    const std::size_t other = i + static_cast<std::size_t>(to);  // wraps to a large number before the first beam
    if (other >= hits.body.size() || hits.body[other] == hits.body[i]) continue;
    const double apart_m = std::abs(hits.distance_m[other] - hits.distance_m[i]);
    if (apart_m > largest_m) {
      largest_m = apart_m;
      side = to;
    }
  }
  return side;
}

Return BeamFootprint::computeReturn(const BeamHits& hits, std::size_t i) {
  if (hits.body[i] == kNoBody) return {};
  const double own_m = hits.distance_m[i];
  return {own_m, errors_.reach_m > 0 ? power(hits.ray(i), own_m, hits.body[i]) : 1};
}

Return BeamFootprint::mixed(const BeamHits& hits, std::size_t i, int side, double distortion) {
  const Ray middle = hits.ray(i);
  const double own_m = hits.distance_m[i];
  const BodyId own = hits.body[i];
  const BodyId other = hits.body[i + static_cast<std::size_t>(side)];
  const bool is_own_nearer = own_m < hits.distance_m[i + static_cast<std::size_t>(side)];
  const Solid nearer = now_.scene.solid(is_own_nearer ? own : other);
  const double own_power = own == kNoBody ? 0 : power(middle, own_m, own);
  // Whether the nearer body is hit decides which of the two is.
  const double edge_tangent = side * errors_.divergence_rad / 2;
  const auto isOther = [&](double share) {
    return intersect(turned(middle, share * edge_tangent), nearer).has_value() != is_own_nearer;
  };
  if (!isOther(1)) return {own_m, errors_.reach_m > 0 ? own_power : 1};
  double own_end = 0, other_begin = 1;  // in half angles from the middle
  for (int n = 0; n < kBisections; ++n) {
    const double between = (own_end + other_begin) / 2;
    (isOther(between) ? other_begin : own_end) = between;
  }
  const double other_share = (1 - (own_end + other_begin) / 2) / 2;
  const Ray edge = turned(middle, edge_tangent);
  double other_m = std::numeric_limits<double>::infinity();
  if (other != kNoBody) other_m = intersect(edge, now_.scene.solid(other)).value_or(other_m);
  const double other_part = std::isfinite(other_m) ? other_share * power(edge, other_m, other) : 0;
  const double own_part = (1 - other_share) * own_power;
  const double both = errors_.reach_m > 0 ? own_part + other_part : 1;
  if (own_part == 0 && other_part == 0) return {};
  if (own_part == 0) return {other_m, both};
  if (other_part == 0) return {own_m, both};
  const double share = std::clamp(other_part / (own_part + other_part) + errors_.mixing_std * distortion, 0.0, 1.0);
  if (std::abs(other_m - own_m) > errors_.mixing_m) return {share > 0.5 ? other_m : own_m, both};
  return {own_m + share * (other_m - own_m), both};
}

}  // namespace robosim
