#include "geometry/index/neighbour_list.h"

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/testing/random_scene.h"

namespace robosim {
namespace {

struct Found {
  std::vector<std::uint32_t> solids;
  bool is_complete = false;
};

Found near(const GridIndex& grid, const NeighbourList& list, const mrpt::math::TPoint2D& from, double reach_m) {
  Found found;
  found.is_complete = list.visitNear(from, reach_m, [&](std::uint32_t i) { found.solids.push_back(grid.numberOf(i)); });
  return found;
}

/// Pillars of radius 0.5 m whose boundaries lie 1, 2, 3 and 20 m ahead of the origin.
GridIndex pillarsAhead() {
  std::vector<Solid> solids;
  for (const double boundary_m : {3.0, 1.0, 20.0, 2.0}) solids.push_back({Circle{{boundary_m + 0.5, 0}, 0.5}, {0, 1}});
  GridIndex grid({-30, 30, -30, 30}, 4);
  grid.build(solids);
  return grid;
}

TEST(NeighbourList, ReportsThatAnEmptyListCoversNothing) {
  const Found found = near(pillarsAhead(), NeighbourList(), {0, 0}, 0.1);
  EXPECT_TRUE(found.solids.empty());
  EXPECT_FALSE(found.is_complete);
}

TEST(NeighbourList, VisitsTheNearestFirstUpToTheReach) {
  const GridIndex grid = pillarsAhead();
  NeighbourList list;
  list.update(grid, {0, 0}, 5);
  EXPECT_EQ(near(grid, list, {0, 0}, 2.5).solids, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(near(grid, list, {0, 0}, 5).solids, (std::vector<std::uint32_t>{1, 3, 0}));
  EXPECT_TRUE(near(grid, list, {0, 0}, 5).is_complete);
  EXPECT_FALSE(near(grid, list, {0, 0}, 19).is_complete) << "it covers 5 m";
}

TEST(NeighbourList, IsRebuiltOnlyAfterItsOwnerCrossedTheSkin) {
  const GridIndex grid = pillarsAhead();
  NeighbourList list;
  list.update(grid, {0, 0}, 2.5);
  EXPECT_TRUE(near(grid, list, {0.6, 0}, 2.5).is_complete) << "within the skin";
  EXPECT_EQ(near(grid, list, {0.6, 0}, 2.5).solids, (std::vector<std::uint32_t>{1, 3, 0}));
  EXPECT_FALSE(near(grid, list, {17, 0}, 2.5).is_complete);
  list.update(grid, {17, 0}, 2.5);
  EXPECT_TRUE(near(grid, list, {17, 0}, 2.5).is_complete);
  EXPECT_EQ(near(grid, list, {17, 0}, 3.5).solids, (std::vector<std::uint32_t>{2}));
}

TEST(NeighbourList, IsRebuiltAsSoonAsItsOwnerHasCrossedTheSkin) {
  const GridIndex grid = pillarsAhead();
  NeighbourList list;
  list.update(grid, {0, 0}, 2.5);
  const mrpt::math::TPoint2D beyond_skin(0.71, 0);  // the skin is 0.7 m wide
  EXPECT_FALSE(near(grid, list, beyond_skin, 2.5).is_complete);
  list.update(grid, beyond_skin, 2.5);
  EXPECT_TRUE(near(grid, list, beyond_skin, 2.5).is_complete);
}

TEST(NeighbourList, ContainsAllSolidsWithinReach) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed);
    const SolidSpread spread{.area = {-20, 20, -20, 20}};
    const auto solids = randomSolids(rng, rng.below(400), spread);
    GridIndex grid(spread.area, 1.5);
    grid.build(solids);
    NeighbourList list;
    mrpt::math::TPoint2D at = randomPoint(rng, spread.area);
    const double reach_m = rng.uniform(0, 12);
    for (int step = 0; step < 20; ++step) {
      at += {rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3)};
      list.update(grid, at, reach_m);
      const Found found = near(grid, list, at, reach_m);
      if (!found.is_complete) continue;  // too many solids: the list reports that it is incomplete
      const std::set<std::uint32_t> listed(found.solids.begin(), found.solids.end());
      ASSERT_EQ(listed.size(), found.solids.size()) << "each once, seed " << seed;
      for (std::uint32_t i = 0; i < solids.size(); ++i) {
        if (distance(solids[i].outline, at) > reach_m) continue;
        ASSERT_TRUE(listed.contains(i)) << "solid " << i << ", seed " << seed << ", step " << step;
      }
    }
  }
}

TEST(NeighbourList, ContainsAllSolidsAtInfiniteReach) {
  const GridIndex grid = pillarsAhead();
  NeighbourList list;
  const double infinity = std::numeric_limits<double>::infinity();
  list.update(grid, {0, 0}, infinity);
  EXPECT_EQ(near(grid, list, {0, 0}, infinity).solids, (std::vector<std::uint32_t>{1, 3, 0, 2}));
}

}  // namespace
}  // namespace robosim
