#include "sensors/beam_footprint.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"

namespace robosim {
namespace {

/// Surfaces that are nearer to each other [m] are the same for a scanner.
constexpr double kSameSurface_m = 0.02;
constexpr int kBisections = 6;

bool areSameSurface(double a_m, double b_m) { return a_m == b_m || std::abs(a_m - b_m) < kSameSurface_m; }

Ray turned(const Ray& ray, double by_rad) {
  return {ray.origin, PlanarTransform({0, 0, by_rad}, 0).turnToWorld(ray.direction)};
}

}  // namespace

double BeamFootprint::power(const Ray& ray, double distance_m, BodyId body) const {
  if (body == kNoBody || distance_m <= 0) return body == kNoBody ? 0 : 1e9;
  const auto at = ray.origin + ray.direction * distance_m;
  const auto normal = normalAt(now_.scene.solid(body).outline, {at.x, at.y});
  const double cosine = std::abs(ray.direction.x * normal.x + ray.direction.y * normal.y);
  const double reach = (errors_.reach_m > 0 ? errors_.reach_m : 1) / distance_m;
  return now_.reflectivityOf(body) * cosine * reach * reach;
}

Return BeamFootprint::returnOf(const BeamHits& hits, std::size_t i, double gaussian) const {
  const double own_m = hits.distance_m[i];
  if (errors_.divergence_rad > 0) {
    // The side on which the adjacent beam hits the more distant surface from this one.
    int side = 0;
    double largest_m = kSameSurface_m;
    for (const int to : {-1, 1}) {
      const std::size_t other = i + static_cast<std::size_t>(to);  // wraps to a large number before the first beam
      if (other >= hits.body.size() || hits.body[other] == hits.body[i]) continue;
      const double apart_m = std::abs(hits.distance_m[other] - own_m);
      if (apart_m > largest_m) {
        largest_m = apart_m;
        side = to;
      }
    }
    if (side != 0) return mixed(hits, i, side, gaussian);
  }
  if (hits.body[i] == kNoBody) return {};
  return {own_m, errors_.reach_m > 0 ? power(hits.rays[i], own_m, hits.body[i]) : 1};
}

Return BeamFootprint::mixed(const BeamHits& hits, std::size_t i, int side, double gaussian) const {
  const Ray& middle = hits.rays[i];
  const double own_m = hits.distance_m[i];
  const double own_power = power(middle, own_m, hits.body[i]);
  const auto hitAt = [&](double share) {
    return now_.scene.castRay(turned(middle, side * share * errors_.divergence_rad / 2), range_max_m_, owner_);
  };
  const Hit edge = hitAt(1);
  if (areSameSurface(edge.distance_m, own_m)) return {own_m, errors_.reach_m > 0 ? own_power : 1};
  double own_end = 0, other_begin = 1;  // in half angles from the middle
  for (int n = 0; n < kBisections; ++n) {
    const double between = (own_end + other_begin) / 2;
    const Hit hit = hitAt(between);
    const bool is_own = hit.body == hits.body[i] || areSameSurface(hit.distance_m, own_m);
    (is_own ? own_end : other_begin) = between;
  }
  const double other_share = (1 - (own_end + other_begin) / 2) / 2;
  const double other_m = edge.distance_m;
  const double other_part = other_share * power(turned(middle, side * errors_.divergence_rad / 2), other_m, edge.body);
  const double own_part = (1 - other_share) * own_power;
  const double both = errors_.reach_m > 0 ? own_part + other_part : 1;
  if (own_part == 0 && other_part == 0) return {};
  if (own_part == 0) return {other_m, both};
  if (other_part == 0) return {own_m, both};
  const double share = std::clamp(other_part / (own_part + other_part) + errors_.mixing_std * gaussian, 0.0, 1.0);
  if (std::abs(other_m - own_m) > errors_.mixing_m) return {share > 0.5 ? other_m : own_m, both};
  return {own_m + share * (other_m - own_m), both};
}

}  // namespace robosim
