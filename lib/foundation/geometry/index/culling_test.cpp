// Culling tests against exact geometry: no class may lose a relevant solid (no false negatives), and each must exclude
// most irrelevant ones.
#include "geometry/index/culling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/vector_width.h"
#include "geometry/casting/bearing_cull.h"
#include "geometry/testing/random_scene.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// Distances [m] from the reference point of the single-precision coordinates.
constexpr double kOffsets_m[] = {0, 300, 40000};

/// Counts how often a class was tested, and its results.
struct Tally {
  int relevant = 0, false_positives = 0, dropped = 0;

  void add(bool is_relevant, bool kept) {
    if (is_relevant) {
      ++relevant;
    } else {
      ++(kept ? false_positives : dropped);
    }
  }
};

TPoint2D directionOf(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

/// How far an outline extends ahead of a point.
double foremost(const Outline& outline, const HalfPlaneCull& half_plane) {
  const auto along = [&](const TPoint2D& v) { return half_plane.facing.x * v.x + half_plane.facing.y * v.y; };
  if (const auto* circle = std::get_if<Circle>(&outline)) {
    return along(circle->center - half_plane.origin) + circle->radius_m * half_plane.facing.norm();
  }
  const auto& box = std::get<OrientedBox>(outline);
  return along(box.center - half_plane.origin) + box.half_length_m * std::abs(along(box.axis)) +
         box.half_width_m * std::abs(along({-box.axis.y, box.axis.x}));
}

/// Tests a disc at one of the four places.
bool mayContain(const RangeCull& cull, const CullDisc& disc, int place) {
  constexpr IndexedDisc kNever{{0, 0, -std::numeric_limits<float>::max()}, 0};
  IndexedDisc discs[] = {kNever, kNever, kNever, kNever};
  discs[place % 4].disc = disc;
  const std::uint32_t kept = cull.mayContain(FourCullDiscs(discs));
  return (kept >> place % 4 & 1) != 0;
}

TEST(RangeCull, KeepsEverySolidWithinReachAndAhead) {
  Rng rng(1);
  Tally tally;
  for (int i = 0; i < 40000; ++i) {
    const double offset_m = kOffsets_m[i % 3];
    const TPoint2D middle(offset_m, -offset_m);
    const TPoint2D facing = i % 2 ? directionOf(rng.uniform(-M_PI, M_PI)) : TPoint2D();
    const HalfPlaneCull half_plane{randomPoint(rng, {-10, 10, -10, 10}), facing, rng.uniform(0, 0.5)};
    const double reach_m = rng.uniform(0, 12);
    const Solid solid = randomSolid(rng, {.area = {-10, 10, -10, 10}});
    const GridItem item = GridItem::from(solid);
    const bool is_ahead = foremost(solid.outline, half_plane) >= -half_plane.margin_m;
    ASSERT_TRUE(half_plane.mayContain(item) || !is_ahead) << "case " << i;
    const bool kept = mayContain(RangeCull(half_plane, reach_m, middle), CullDisc::from(item, middle), i);
    const bool is_relevant = is_ahead && distance(solid.outline, half_plane.origin) <= reach_m;
    ASSERT_TRUE(kept || !is_relevant) << "case " << i;
    tally.add(is_relevant, kept);
  }
  EXPECT_GT(tally.relevant, 5000);
  EXPECT_GT(tally.dropped, 4 * tally.false_positives);
}

TEST(RangeCull, KeepsAllAtInfiniteReach) {
  const GridItem far = GridItem::from({Circle{{1e30, -1e30}, 1}, {0, 1}});
  EXPECT_TRUE(mayContain(RangeCull({}, INFINITY, {0, 0}), CullDisc::from(far, {0, 0}), 0));
}

TEST(CellHalfPlaneCull, KeepsEveryCellThatReachesIntoTheHalfPlane) {
  Rng rng(3);
  Tally tally;
  for (int i = 0; i < 20000; ++i) {
    const TPoint2D low = randomPoint(rng, {-300, 300, -300, 300});
    const double cell_m = rng.uniform(0.25, 4);
    const int column = static_cast<int>(rng.below(20)), row = static_cast<int>(rng.below(20));
    const TPoint2D facing = directionOf(rng.uniform(-M_PI, M_PI));
    const TPoint2D origin(low.x + rng.uniform(0, 20) * cell_m, low.y + rng.uniform(0, 20) * cell_m);
    const HalfPlaneCull half_plane{origin, facing, rng.uniform(0, 1)};
    double foremost_m = -INFINITY;
    for (const int corner : {0, 1, 2, 3}) {
      const double x = low.x + (column + corner % 2) * cell_m, y = low.y + (row + corner / 2) * cell_m;
      foremost_m = std::max(foremost_m, facing.x * (x - origin.x) + facing.y * (y - origin.y));
    }
    const bool kept = CellHalfPlaneCull(half_plane, low, cell_m).mayContain(column, row);
    const bool is_relevant = foremost_m >= -half_plane.margin_m;
    ASSERT_TRUE(kept || !is_relevant) << "case " << i;
    tally.add(is_relevant, kept);
  }
  EXPECT_GT(tally.relevant, 5000);
  EXPECT_GT(tally.dropped, 100 * tally.false_positives) << "a cell's corners are exact, but for rounding";
}

/// Whether a bearing lies in the bins of a candidate.
bool contains(const BearingArrays& arrays, std::size_t k, double bearing_rad) {
  const int bin = std::min(static_cast<int>((bearing_rad / M_PI + 1) / 2 * kBearingBins), int{kBearingBins} - 1);
  const auto is_in = [&](int b) { return arrays.first[k] <= b && b <= arrays.last[k]; };
  return is_in(bin) || is_in(bin + int{kBearingBins});
}

/// Computes bins with the widest vectors and without.
template <bool kDisc>
void findWithAllWidths(const CullFrame& frame, const Candidates& candidates, BearingArrays& arrays, Rng& rng) {
  gather<kDisc>(candidates, frame, 1, arrays);
  if (rng.below(2)) {
    findBins<kDisc>(frame, candidates.count, arrays);
  } else {
    withVectors < [](const CullFrame* f, std::size_t count, BearingArrays* a) __attribute__((always_inline)) {
      findBins<kDisc>(*f, count, *a);
    }
    > (&frame, candidates.count, &arrays);
  }
}

template <bool kDisc>
void expectBearingsOfEveryHit(double precision) {
  Rng rng(5);
  Tally tally;
  BearingArrays arrays{};
  for (int i = 0; i < 2000; ++i) {
    const TPoint2D at = randomPoint(rng, {-10, 10, -10, 10});
    std::vector<Solid> solids;
    std::vector<GridItem> items;
    for (std::uint32_t k = 0; k < Candidates::kCapacity; ++k) {
      solids.push_back(randomSolid(rng, {.area = {-10, 10, -10, 10}}));
      solids.back().heights = {0, 2};
      items.push_back(GridItem::from(solids.back()));
    }
    Candidates candidates;
    candidates.count = 0;
    for (const auto& item : items) candidates.addIf(true, item, 0);
    candidates.pad();
    const double turn_rad = rng.uniform(-M_PI, M_PI), spread_m = rng.below(2) ? 0 : rng.uniform(0, 0.5);
    const CullFrame frame{at.x,
                          at.y,
                          static_cast<float>(std::cos(turn_rad)),
                          static_cast<float>(std::sin(turn_rad)),
                          static_cast<float>(spread_m),
                          0,
                          INFINITY};
    findWithAllWidths<kDisc>(frame, candidates, arrays, rng);
    for (int r = 0; r < 20; ++r) {
      const double bearing_rad = rng.uniform(-M_PI, M_PI);
      const TPoint2D mount = directionOf(rng.uniform(-M_PI, M_PI)) * spread_m;
      const Ray ray = Ray::towards({at.x + mount.x, at.y + mount.y, 1}, turn_rad + bearing_rad);
      for (std::size_t k = 0; k < solids.size(); ++k) {
        const bool kept = contains(arrays, k, bearing_rad);
        const auto met_m = intersect(ray, solids[k]);
        ASSERT_TRUE(kept || !met_m) << "case " << i << ", solid " << k;
        ASSERT_TRUE(!met_m || *met_m >= static_cast<double>(arrays.nearest[k])) << "case " << i;
        tally.add(met_m.has_value(), kept);
      }
    }
  }
  EXPECT_GT(tally.relevant, 5000);
  EXPECT_GT(tally.dropped, precision * tally.false_positives);
}

TEST(BearingCull, ContainsEveryBearingAtWhichASolidIsHit) { expectBearingsOfEveryHit<false>(4); }

TEST(BearingCull, ContainsEveryBearingAtWhichACoveringDiscIsHit) { expectBearingsOfEveryHit<true>(2); }

}  // namespace
}  // namespace robosim
