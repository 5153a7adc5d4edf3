#include "geometry/center_index.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "geometry/random_scene.h"

namespace robosim {
namespace {

std::vector<std::uint32_t> near(const CenterIndex& index, const Bounds2D& area) {
  std::vector<std::uint32_t> found;
  index.visitNear(area, [&](const CenterIndex::Entry& entry) { found.push_back(entry.index); });
  std::sort(found.begin(), found.end());
  return found;
}

TEST(CenterIndex, FindsWhatReachesOverFromTheNextCell) {
  CenterIndex index({0, 8, 0, 8}, 2, 2);
  index.set(0, {Circle{{1.9, 1}, 0.5}, {0, 1}});
  index.set(1, {Circle{{7, 7}, 0.5}, {0, 1}});
  index.build();
  EXPECT_EQ(near(index, {2.2, 2.3, 0.9, 1.1}), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(near(index, {0, 8, 0, 8}), (std::vector<std::uint32_t>{0, 1}));
}

TEST(CenterIndex, KeepsASolidWhereItWasUntilItIsBuiltAgain) {
  CenterIndex index({0, 8, 0, 8}, 2, 1);
  index.set(0, {Circle{{1, 1}, 0.5}, {0, 1}});
  index.build();
  index.set(0, {Circle{{7, 7}, 0.5}, {0, 1}});
  EXPECT_EQ(near(index, {0, 1, 0, 1}).size(), 1u);
  index.build();
  EXPECT_TRUE(near(index, {0, 1, 0, 1}).empty());
  EXPECT_EQ(near(index, {6, 8, 6, 8}).size(), 1u);
}

TEST(CenterIndex, LeavesOutNothingNearAnAreaOrAlongARayAndNamesEachOnce) {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Rng rng(seed);
    // Some beyond the area, which the cells of the rim stand for.
    const SolidSpread spread{.area = {-12, 12, -15, 15}, .size_max_m = rng.uniform(0.2, 4)};
    const std::size_t count = 1 + rng.below(40);
    const auto solids = randomSolids(rng, count, spread);
    CenterIndex index({-10, 10, -10, 10}, rng.uniform(0.5, 8), count);
    for (std::size_t i = 0; i < count; ++i) index.set(i, solids[i]);
    index.build();

    const auto corner = randomPoint(rng, spread.area);
    const Bounds2D area{corner.x, corner.x + rng.uniform(0, 5), corner.y, corner.y + rng.uniform(0, 5)};
    const auto found = near(index, area);
    ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end()) << "seed " << seed;

    const Ray ray = randomRay(rng, spread.area, 0, 2);
    const double range_m = rng.below(4) ? rng.uniform(0, 30) : std::numeric_limits<double>::infinity();
    std::vector<std::uint32_t> along;
    index.visitAlong(
        ray, [&] { return range_m; }, [&](const CenterIndex::Entry& entry) { along.push_back(entry.index); });
    std::sort(along.begin(), along.end());
    ASSERT_EQ(std::adjacent_find(along.begin(), along.end()), along.end()) << "seed " << seed;

    for (std::uint32_t i = 0; i < count; ++i) {
      const Bounds2D bounds = boundsOf(solids[i].outline);
      const bool meets = bounds.x_min <= area.x_max && area.x_min <= bounds.x_max && bounds.y_min <= area.y_max &&
                         area.y_min <= bounds.y_max;
      ASSERT_TRUE(!meets || std::binary_search(found.begin(), found.end(), i)) << "solid " << i << ", seed " << seed;
      const auto met = intersect(ray, solids[i]);
      if (met && *met <= range_m) {
        ASSERT_TRUE(std::binary_search(along.begin(), along.end(), i)) << "solid " << i << ", seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace robosim
