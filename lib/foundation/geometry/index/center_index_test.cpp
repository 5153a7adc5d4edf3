#include "geometry/index/center_index.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "geometry/testing/random_scene.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

std::vector<std::uint32_t> near(const CenterIndex& index, const Bounds2D& area) {
  std::vector<std::uint32_t> found;
  index.visitNear(area, [&](const CenterIndex::Entry& entry) { found.push_back(entry.index); });
  std::sort(found.begin(), found.end());
  return found;
}

TEST(CenterIndex, FindsSolidsThatExtendIntoTheArea) {
  CenterIndex index(2);
  index.set(0, {Circle{{1.9, 1}, 0.5}, {0, 1}});
  index.set(1, {Circle{{7, 7}, 0.5}, {0, 1}});
  index.build();
  EXPECT_EQ(near(index, {2.2, 2.3, 0.9, 1.1}), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(near(index, {0, 8, 0, 8}), (std::vector<std::uint32_t>{0, 1}));
}

TEST(CenterIndex, IsTheSameForAnyNumberOfThreads) {
  for (const std::size_t count : {8192u, 20'000u, 70'000u}) {
    Rng rng(count);
    const auto solids = randomSolids(rng, count, {.area = {-300, 300, -200, 200}, .size_max_m = 1});
    CenterIndex one(count), several(count);
    for (CenterIndex* index : {&one, &several}) {
      for (std::size_t i = 0; i < count; ++i) index->set(i, solids[i]);
      for (std::size_t i = 3; i < count; i += 7) index->remove(i);
    }
    one.build();
    several.build(ParallelExecutor(3));
    const auto in_order = [](const CenterIndex& index, const Bounds2D& area) {
      std::vector<std::uint32_t> found;
      index.visitNear(area, [&](const CenterIndex::Entry& entry) { found.push_back(entry.index); });
      return found;
    };
    const Bounds2D everything{-1000, 1000, -1000, 1000};
    EXPECT_EQ(in_order(one, everything), in_order(several, everything)) << count;
    EXPECT_EQ(in_order(one, everything).size(), count - (count - 3 + 6) / 7);
    for (int i = 0; i < 200; ++i) {
      const double x = rng.uniform(-310, 310), y = rng.uniform(-210, 210);
      const Bounds2D area{x, x + rng.uniform(0, 30), y, y + rng.uniform(0, 30)};
      EXPECT_EQ(in_order(one, area), in_order(several, area)) << count;
    }
  }
}

TEST(CenterIndex, AppliesChangesOnlyAtBuild) {
  CenterIndex index(3);
  index.set(0, {Circle{{1, 1}, 0.5}, {0, 1}});
  index.set(1, {Circle{{0, 0}, 0.5}, {0, 1}});
  index.set(2, {Circle{{8, 8}, 0.5}, {0, 1}});
  index.build();
  index.set(0, {Circle{{7, 7}, 0.5}, {0, 1}});
  EXPECT_EQ(near(index, {0, 1, 0, 1}), (std::vector<std::uint32_t>{0, 1}));
  index.build();
  EXPECT_EQ(near(index, {0, 1, 0, 1}), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(near(index, {6, 8, 6, 8}), (std::vector<std::uint32_t>{0, 2}));
}

TEST(CenterIndex, BuiltOfSomeSolidsFindsOnlyThoseUntilTheNextBuild) {
  CenterIndex index(4);
  for (std::size_t i = 0; i < 4; ++i) index.set(i, {Circle{{static_cast<double>(i), 1}, 0.25}, {0, 1}});
  index.remove(3);
  const ParallelExecutor one(1);
  index.build(one, std::vector<std::uint32_t>{0, 2, 3});
  EXPECT_EQ(near(index, {-9, 9, -9, 9}), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(index.items().size(), 4u);
  index.build(one, {});
  EXPECT_EQ(near(index, {-9, 9, -9, 9}), std::vector<std::uint32_t>());
  index.build();
  EXPECT_EQ(near(index, {-9, 9, -9, 9}), (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(CenterIndex, BuiltOfOneOfManySolidsFindsItAlone) {
  constexpr std::uint32_t kCount = 100;
  CenterIndex index(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) index.set(i, {Circle{{3.0 * (i % 10), 3.0 * (i / 10)}, 0.5}, {0, 1}});
  index.build();
  index.build(ParallelExecutor(1), std::vector<std::uint32_t>{55});
  EXPECT_EQ(near(index, {-999, 999, -999, 999}), (std::vector<std::uint32_t>{55}));
  EXPECT_EQ(near(index, {14, 14.6, 14, 14.6}), (std::vector<std::uint32_t>{55}));
  index.build();
  EXPECT_EQ(near(index, {0, 1, 0, 1}), (std::vector<std::uint32_t>{0}));
}

TEST(CenterIndex, BuiltOfSomeSolidsIsTheSameForAnyNumberOfThreads) {
  constexpr std::size_t kCount = 30'000;
  Rng rng(1);
  const auto solids = randomSolids(rng, kCount, {.area = {-300, 300, -200, 200}, .size_max_m = 1});
  std::vector<std::uint32_t> some;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    if (rng.below(2) == 0) some.push_back(i);
  }
  const auto all_of = [&](int threads) {
    CenterIndex index(kCount);
    for (std::size_t i = 0; i < kCount; ++i) index.set(i, solids[i]);
    index.build(ParallelExecutor(threads), some);
    std::vector<std::uint32_t> found;
    index.visitNear({-999, 999, -999, 999}, [&](const CenterIndex::Entry& entry) { found.push_back(entry.index); });
    return found;
  };
  const auto found = all_of(1);
  EXPECT_EQ(found, all_of(3));
  EXPECT_EQ(found.size(), some.size());
}

TEST(CenterIndex, VisitsAllSolidsNearAnAreaOrRayOnce) {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Rng rng(seed);
    const SolidSpread spread{.area = {-12, 12, -15, 15}, .size_max_m = rng.uniform(0.2, 4)};
    const std::size_t count = 1 + rng.below(40);
    auto solids = randomSolids(rng, count, spread);
    // Some outliers, which the border cells list.
    for (std::uint32_t far = rng.below(3); far-- > 0;)
      solids[rng.below(static_cast<std::uint32_t>(count))] = {Circle{{12, -15}, 3}, {0, 2}};
    CenterIndex index(count);
    for (std::size_t i = 0; i < count; ++i) index.set(i, solids[i]);
    std::vector<std::uint8_t> is_removed(count);
    for (std::size_t i = 0; i < count; ++i) is_removed[i] = seed % 2 == 0 && rng.below(3) == 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (is_removed[i]) index.remove(i);
    }
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
      if (is_removed[i]) {
        ASSERT_FALSE(std::binary_search(found.begin(), found.end(), i)) << "solid " << i << ", seed " << seed;
        ASSERT_FALSE(std::binary_search(along.begin(), along.end(), i)) << "solid " << i << ", seed " << seed;
        continue;
      }
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

/// Average number of entries that a query of 5 m around a solid reads.
double entriesRead(const std::vector<TPoint2D>& places) {
  CenterIndex index(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) index.set(i, {Circle{places[i], 0.2}, {0, 1}});
  index.build();
  std::size_t read = 0;
  for (const auto& p : places) {
    index.visitNear({p.x - 5, p.x + 5, p.y - 5, p.y + 5}, [&](const CenterIndex::Entry&) { ++read; });
  }
  return static_cast<double>(read) / static_cast<double>(places.size());
}

std::vector<TPoint2D> placesIn(const Bounds2D& area, std::size_t count) {
  Rng rng(1);
  std::vector<TPoint2D> places;
  for (std::size_t i = 0; i < count; ++i) places.push_back(randomPoint(rng, area));
  return places;
}

// 1,000 solids in a square of 100 m: 0.1 per square metre. A query reads whole cells of 3.2 m that a square of 10.4 m
// touches, at most 5 × 5 of them or 250 m²: 25 entries, and somewhat more where solids are denser.
TEST(CenterIndex, ReadsAboutAsManyEntriesAsLieNearby) {
  const double at_origin = entriesRead(placesIn({-50, 50, -50, 50}, 1000));
  EXPECT_LT(at_origin, 27);
  EXPECT_NEAR(entriesRead(placesIn({9900, 10000, -5000, -4900}, 1000)), at_origin, 1);
}

TEST(CenterIndex, ReadsFewMoreEntriesWithOutliers) {
  auto places = placesIn({-50, 50, -50, 50}, 1000);
  const double together = entriesRead(places);
  places[0] = {10000, 10000};
  places[1] = {-10000, 10000};
  EXPECT_LT(entriesRead(places), 3 * together);
}

TEST(CenterIndex, ReadsFewEntriesOfALine) {
  // 1,000 along 10 km, one every 10 m: a query of 10.4 m touches at most 3 cells of 10 m, and reads 3 or 4 entries.
  EXPECT_LT(entriesRead(placesIn({0, 10000, 7, 7}, 1000)), 4.5);
}

}  // namespace
}  // namespace robosim
