#include "geometry/casting/single_ray.h"

#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/testing/random_scene.h"

namespace robosim {
namespace {

double enterSlowly(const GridItem& item, const Ray& ray) {
  const double ox = item.x - ray.origin.x;
  const double oy = item.y - ray.origin.y;
  const double dx = ray.direction.x;
  const double dy = ray.direction.y;
  return item.isCircle()
             ? intersectCircle(ox, oy, dx, dy, item.half_length_m)
             : intersectBox(ox, oy, dx, dy, item.axis_x, item.axis_y, item.half_length_m, item.half_width_m);
}

TEST(IntersectItem, IsBitIdenticalToTheFormulaOfEachShape) {
  Rng rng(1);
  int met = 0;
  for (const double lattice_m : {0.0, 0.25}) {
    const SolidSpread spread{.lattice_m = lattice_m};
    for (int scene = 0; scene < 200; ++scene) {
      const auto solids = randomSolids(rng, 20, spread);
      for (int i = 0; i < 200; ++i) {
        Ray ray = randomPlanarRay(rng, spread.area, 0, 2);
        if (i % 4 == 0) ray.direction = {i % 8 ? 1.0 : -0.0, i % 8 ? 0.0 : -1.0, 0};  // along faces
        if (i % 4 == 1 && lattice_m > 0) ray.origin = {std::round(ray.origin.x), std::round(ray.origin.y), 0};
        for (const auto& solid : solids) {
          const GridItem item = GridItem::from(solid);
          const double got =
              intersectItem(item, DoublePair{ray.origin.x, ray.origin.y}, DoublePair{ray.direction.x, ray.direction.y});
          const double wanted = enterSlowly(item, ray);
          ASSERT_EQ(std::bit_cast<std::uint64_t>(got), std::bit_cast<std::uint64_t>(wanted)) << got << " " << wanted;
          met += std::isfinite(got) ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(met, 30000);
}

}  // namespace
}  // namespace robosim
