#pragma once
#include <cstdint>
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

inline Hit senseSectorSlowly(const Scene& scene, const Sector& sector, double range_m, BodyId except) {
  Hit best;
  for (std::size_t i = 0; i < bodyCount(scene); ++i) {
    if (body(i) == except) continue;
    const auto hit = nearestInSector(sector, scene.solid(body(i)));
    if (hit && hit->distance_m < range_m && hit->distance_m < best.distance_m) {
      best = {hit->distance_m, body(i), {hit->point.x, hit->point.y, sector.apex.z}};
    }
  }
  return best;
}

/// Description of the difference between two results, which must be bit-identical because an index only selects
/// candidates; empty when they are equal.
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

}  // namespace robosim
