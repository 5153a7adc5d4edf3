#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <variant>

#include "geometry/scene.h"

/// A scene's answers, by loops over all its solids.
namespace robosim {

inline std::size_t bodyCount(const Scene& scene) { return scene.stationaryCount() + scene.movingCount(); }
inline BodyId body(std::size_t i) { return BodyId(static_cast<std::uint32_t>(i)); }

/// The solid, larger all around by a hair.
inline Solid grown(Solid solid, double hair_m) {
  if (auto* circle = std::get_if<Circle>(&solid.outline)) {
    circle->radius_m += hair_m;
  } else {
    auto& box = std::get<OrientedBox>(solid.outline);
    box.half_length_m += hair_m;
    box.half_width_m += hair_m;
  }
  solid.heights.z_min_m -= hair_m;
  solid.heights.z_max_m += hair_m;
  return solid;
}

/// What castRay is to find, asked of one solid after the other.
inline Hit castRaySlowly(const Scene& scene, const Ray& ray, double range_m, BodyId except, double hair_m = 0) {
  Hit best;
  for (std::size_t i = 0; i < bodyCount(scene); ++i) {
    if (body(i) == except) continue;
    const Solid& solid = scene.solid(body(i));
    const auto distance_m = intersect(ray, hair_m == 0 ? solid : grown(solid, hair_m));
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

inline std::string gotAndExpected(const Hit& got, const Hit& expected) {
  std::ostringstream text;
  text.precision(17);
  text << "got body " << static_cast<std::uint32_t>(got.body) << " at " << got.distance_m << " m, expected body "
       << static_cast<std::uint32_t>(expected.body) << " at " << expected.distance_m << " m";
  return text.str();
}

/// What of an answer is not the same bit for bit; empty when all is.
inline std::string whatDiffers(const Hit& got, const Hit& expected) {
  const bool is_same =
      got.body == expected.body && got.distance_m == expected.distance_m && (!expected || got.point == expected.point);
  return is_same ? "" : gotAndExpected(got, expected);
}

/// What is wrong with what castRay finds; empty when it is the same body within 1e-9 m. It may reckon otherwise than
/// intersect() in the last digits; so where a hair decides whether or which solid the ray meets within range, any
/// answer between those for solids a hair larger and smaller will do, if the ray really meets the body named.
inline std::string whatIsWrong(const Hit& fast, const Scene& scene, const Ray& ray, double range_m, BodyId except) {
  constexpr double kHair_m = 1e-11, kSame_m = 1e-9, kInfinity = std::numeric_limits<double>::infinity();
  if (fast && !((fast.point - ray.at(fast.distance_m)).norm() == 0 && fast.distance_m < range_m)) {
    return "its point is not on the ray at its distance, within range";
  }
  const Hit slow = castRaySlowly(scene, ray, range_m, except);
  if (fast.body == slow.body && (!slow || std::abs(fast.distance_m - slow.distance_m) < kSame_m)) return "";
  const Hit first = castRaySlowly(scene, ray, kInfinity, except, kHair_m);
  const Hit last = castRaySlowly(scene, ray, kInfinity, except, -kHair_m);
  const double got_m = std::min(fast.distance_m, range_m);
  const bool in_order =
      std::min(first.distance_m, range_m) - kSame_m <= got_m && got_m <= std::min(last.distance_m, range_m) + kSame_m;
  const auto named = fast ? intersect(ray, grown(scene.solid(fast.body), kHair_m)) : std::nullopt;
  const bool is_there = !fast || (fast.body != except && named && *named <= fast.distance_m + kSame_m);
  return in_order && is_there ? "" : gotAndExpected(fast, slow);
}

}  // namespace robosim
