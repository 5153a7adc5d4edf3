#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>

#include "geometry/scene.h"

/// Reference implementations of scene queries as loops over all solids.
namespace robosim {

inline std::size_t bodyCount(const Scene& scene) { return scene.stationaryCount() + scene.movingCount(); }
inline BodyId body(std::size_t i) { return BodyId(static_cast<std::uint32_t>(i)); }

/// Expected result of castRay: tests one solid after another.
inline Hit castRaySlowly(const Scene& scene, const Ray& ray, double range_m, BodyId except) {
  Hit best;
  for (std::size_t i = 0; i < bodyCount(scene); ++i) {
    if (body(i) == except) continue;
    const auto distance_m = intersect(ray, scene.solid(body(i)));
    if (distance_m && *distance_m < range_m && *distance_m < best.distance_m) {
      best = {*distance_m, body(i), ray.at(*distance_m)};
    }
  }
  return best;
}

/// Description of the difference between two results of castRay(), which must be bit-identical because an index only
/// selects candidates; empty when they are equal.
inline std::string whatDiffers(const Hit& got, const Hit& expected) {
  if (got.body == expected.body && got.distance_m == expected.distance_m &&
      (!expected || got.point == expected.point)) {
    return "";
  }
  std::ostringstream text;
  text.precision(17);
  text << "got body " << static_cast<std::uint32_t>(got.body) << " at " << got.distance_m << " m, expected body "
       << static_cast<std::uint32_t>(expected.body) << " at " << expected.distance_m << " m";
  return text.str();
}

/// Casts a batch of one sector.
inline Hit senseSector(const Scene& scene, const Sector& sector, double range_m, BodyId except = kNoBody) {
  const BeamFan fan(std::span(&sector, 1));
  BeamBatch batch;
  batch.place(fan, {}, range_m);
  scene.cast(batch, except);
  if (batch.body(0) == BeamBatch::kNothing) return {};
  const auto out = batch.towards(0);
  return {batch.distance(0), body(static_cast<std::size_t>(batch.body(0))),
          sector.apex + mrpt::math::TPoint3D(out.x, out.y, 0)};
}

/// Distance [m] to the nearest point of a solid in a sector: outline and sector are both convex, so if the outline's
/// nearest point lies outside the sector, the nearest point inside it lies where an edge of the sector enters the
/// outline.
inline std::optional<double> nearestInSector(const Sector& sector, const Solid& solid) {
  if (!solid.heights.contains(sector.apex.z)) return std::nullopt;
  const mrpt::math::TPoint2D apex(sector.apex.x, sector.apex.y);
  const mrpt::math::TPoint2D out = nearestPoint(solid.outline, apex) - apex;
  if (sector.contains(out)) return out.norm();
  std::optional<double> best_m;
  for (const auto& edge : {sector.left, sector.right}) {
    const auto distance_m = intersect({sector.apex, {edge.x, edge.y, 0}}, solid);
    if (distance_m && (!best_m || *distance_m < *best_m)) best_m = distance_m;
  }
  return best_m;
}

/// Distance [m] to the nearest body in a sector, infinite if none is nearer than the range.
inline double senseSectorSlowly(const Scene& scene, const Sector& sector, double range_m, BodyId except) {
  double best_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodyCount(scene); ++i) {
    if (body(i) == except) continue;
    const auto distance_m = nearestInSector(sector, scene.solid(body(i)));
    if (distance_m && *distance_m < range_m && *distance_m < best_m) best_m = *distance_m;
  }
  return best_m;
}

/// The sector with both edges turned outwards.
inline Sector widened(const Sector& sector, double by_rad) {
  const auto turned = [](const mrpt::math::TPoint2D& v, double angle) {
    return mrpt::math::TPoint2D(v.x * std::cos(angle) - v.y * std::sin(angle),
                                v.x * std::sin(angle) + v.y * std::cos(angle));
  };
  return {sector.apex, sector.axis, turned(sector.left, by_rad), turned(sector.right, -by_rad)};
}

/// Description of the difference between a batch of one sector and the reference, beyond rounding; empty when there is
/// none. Where an edge of the sector just touches a solid, both results are right.
inline std::string whatDiffers(const Scene& scene, const Sector& sector, double range_m, BodyId except) {
  constexpr double kTurn_rad = 1e-9;
  const double error_m = 1e-9 + 1e-15 * (std::abs(sector.apex.x) + std::abs(sector.apex.y));
  const Sector wider = widened(sector, kTurn_rad);
  const Hit got = senseSector(scene, sector, range_m, except);
  const double first_m = senseSectorSlowly(scene, wider, range_m + error_m, except);
  const double last_m = senseSectorSlowly(scene, widened(sector, -kTurn_rad), range_m - error_m, except);
  const auto of_body = got ? nearestInSector(wider, scene.solid(got.body)) : std::nullopt;
  if (got.distance_m >= first_m - error_m && got.distance_m <= last_m + error_m &&
      (!got || (of_body && *of_body <= got.distance_m + error_m))) {
    return "";
  }
  std::ostringstream text;
  text.precision(17);
  text << "got body " << static_cast<std::uint32_t>(got.body) << " at " << got.distance_m << " m, expected " << first_m
       << " m to " << last_m << " m";
  return text.str();
}

}  // namespace robosim
