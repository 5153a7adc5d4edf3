#include "robosim_bench/ray_scene.h"

#include <algorithm>
#include <cmath>

#include "base/angle_units.h"
#include "base/random.h"
#include "geometry/testing/random_scene.h"

namespace robosim {
namespace {

constexpr Bounds2D kArea{-RayScene::kHalf_m, RayScene::kHalf_m, -RayScene::kHalf_m, RayScene::kHalf_m};

/// A random point outside all solids, with a margin for single precision.
mrpt::math::TPose2D freePlace(Rng& rng, const std::vector<Solid>& solids) {
  constexpr double kGap_m = 0.01;
  for (;;) {
    const auto point = randomPoint(rng, kArea);
    const auto near = [&](const Solid& solid) { return distance(solid.outline, point) < kGap_m; };
    if (std::none_of(solids.begin(), solids.end(), near)) return {point.x, point.y, rng.uniform(-M_PI, M_PI)};
  }
}

}  // namespace

double beamAngle(std::size_t i) { return toRadians(static_cast<double>(i) - 90); }

RayScene makeRayScene(std::size_t places, std::uint64_t seed) {
  constexpr std::size_t kOfEachKind = 500;
  constexpr HeightSpan kHeights{0, 1};
  Rng rng(seed, RandomPurpose::scenery);
  const auto half_width = [&] { return rng.uniform(0.1, 0.6); };
  RayScene scene;
  for (std::size_t i = 0; i < kOfEachKind; ++i) {
    const auto middle = randomPoint(rng, kArea);
    scene.solids.push_back({Circle{middle, half_width()}, kHeights});
    const auto center = randomPoint(rng, kArea);
    const double length_m = 2 * half_width();
    const double width_m = 2 * half_width();
    const mrpt::math::TPose2D world_from_box(center.x, center.y, rng.uniform(-M_PI, M_PI));
    scene.solids.push_back({OrientedBox::from(world_from_box, length_m, width_m), kHeights});
  }
  for (std::size_t i = 0; i < places; ++i) {
    const auto scanner = freePlace(rng, scene.solids);
    scene.world_from_scanner.push_back(scanner);
    for (std::size_t beam = 0; beam < RayScene::kBeams; ++beam) {
      scene.beams.push_back(Ray::towards({scanner.x, scanner.y, RayScene::kHeight_m}, scanner.phi + beamAngle(beam)));
    }
  }
  for (std::size_t i = 0; i < places * RayScene::kBeams; ++i) {
    const auto from = freePlace(rng, scene.solids);
    scene.singles.push_back(Ray::towards({from.x, from.y, RayScene::kHeight_m}, from.phi));
  }
  return scene;
}

}  // namespace robosim
