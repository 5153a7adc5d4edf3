#include "geometry/shapes/solid.h"

#include <gtest/gtest.h>

#include "geometry/testing/random_scene.h"
#include "geometry/testing/slow_geometry.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

const HeightSpan kFloor{0, 1};

Solid disc(double x, double y, double radius_m, HeightSpan heights = kFloor) {
  return {Circle{{x, y}, radius_m}, heights};
}
Solid box(double x, double y, double length_m, double width_m, double turn_rad = 0, HeightSpan heights = kFloor) {
  return {OrientedBox::from({x, y, turn_rad}, length_m, width_m), heights};
}

/// 0 when sides cross or one box contains a corner of the other; otherwise the minimum distance of all corners to all
/// sides.
Real slowDistance(const OrientedBox& a, const OrientedBox& b) {
  const auto p = cornersOf(a), q = cornersOf(b);
  Real nearest = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    if (signedExcess(a, q[i]) <= 0 || signedExcess(b, p[i]) <= 0) return 0;
    const RealPoint p1 = p[i], p2 = p[(i + 1) % 4];
    for (std::size_t k = 0; k < 4; ++k) {
      const RealPoint q1 = q[k], q2 = q[(k + 1) % 4];
      const bool crosses = cross(p2 - p1, q1 - p1) * cross(p2 - p1, q2 - p1) < 0 &&
                           cross(q2 - q1, p1 - q1) * cross(q2 - q1, p2 - q1) < 0;
      if (crosses) return 0;
      nearest = std::min({nearest, slowDistanceToSegment(p1, q1, q2), slowDistanceToSegment(q1, p1, p2)});
    }
  }
  return nearest;
}

Real slowDistance(const Outline& a, const Outline& b) {
  const auto* circle_a = std::get_if<Circle>(&a);
  const auto* circle_b = std::get_if<Circle>(&b);
  if (circle_a) return std::max(Real(0), slowDistance(b, real(circle_a->center)) - circle_a->radius_m);
  if (circle_b) return slowDistance(b, a);
  return slowDistance(std::get<OrientedBox>(a), std::get<OrientedBox>(b));
}

TEST(HeightSpan, ContainsItsEndsButDoesNotOverlapAtACommonEnd) {
  const HeightSpan span{1, 2};
  EXPECT_TRUE(span.contains(1));
  EXPECT_TRUE(span.contains(2));
  EXPECT_FALSE(span.contains(std::nextafter(2, 3)));
  EXPECT_FALSE(span.overlaps({2, 3}));
  EXPECT_FALSE(span.overlaps({0, 1}));
  EXPECT_TRUE(span.overlaps({1.5, 1.6}));
  EXPECT_TRUE(span.overlaps(span));
}

TEST(OrientedBox, LiesAlongItsPosesHeading) {
  const OrientedBox turned = OrientedBox::from({1, 2, M_PI / 6}, 4, 2);
  EXPECT_EQ(turned.center, TPoint2D(1, 2));
  EXPECT_NEAR(turned.axis.x, std::sqrt(3) / 2, 1e-15);
  EXPECT_NEAR(turned.axis.y, 0.5, 1e-15);
  EXPECT_EQ(turned.half_length_m, 2);
  EXPECT_EQ(turned.half_width_m, 1);
}

TEST(BoundsOf, AreTheSmallestRectangle) {
  EXPECT_EQ(boundsOf(Circle{{1, -2}, 0.5}), (Bounds2D{0.5, 1.5, -2.5, -1.5}));
  EXPECT_EQ(boundsOf(OrientedBox{{1, 2}, {0, 1}, 3, 1}), (Bounds2D{0, 2, -1, 5}));
  // A 3-4-5 turn: (4, 3)/5 along, (-3, 4)/5 across. Half extents 4·5/5 + 3·10/5 = 10 and 3·5/5 + 4·10/5 = 11.
  const Bounds2D turned = boundsOf(OrientedBox{{0, 0}, {0.8, 0.6}, 5, 10});
  EXPECT_NEAR(turned.x_max, 10, 1e-14);
  EXPECT_NEAR(turned.x_min, -10, 1e-14);
  EXPECT_NEAR(turned.y_max, 11, 1e-14);
  EXPECT_NEAR(turned.y_min, -11, 1e-14);
}

TEST(BoundsOf, TouchTheOutermostCornersOfRandomBoxes) {
  Rng rng(1);
  for (int i = 0; i < 10000; ++i) {
    const OrientedBox b = randomBox(rng, {.size_max_m = 30});
    const Bounds2D bounds = boundsOf(b);
    const auto corners = cornersOf(b);
    const auto [left, right] =
        std::minmax_element(corners.begin(), corners.end(), [](auto p, auto q) { return p.x < q.x; });
    const auto [low, high] =
        std::minmax_element(corners.begin(), corners.end(), [](auto p, auto q) { return p.y < q.y; });
    ASSERT_NEAR(bounds.x_min, left->x, 1e-12);
    ASSERT_NEAR(bounds.x_max, right->x, 1e-12);
    ASSERT_NEAR(bounds.y_min, low->y, 1e-12);
    ASSERT_NEAR(bounds.y_max, high->y, 1e-12);
  }
}

TEST(NearestPoint, IsOnTheFaceBeforeItOrOnTheCornerOrThePointItself) {
  const Outline b = OrientedBox{{0, 0}, {1, 0}, 2, 1};
  EXPECT_EQ(nearestPoint(b, {5, 0.5}), TPoint2D(2, 0.5));
  EXPECT_EQ(nearestPoint(b, {-1, -3}), TPoint2D(-1, -1));
  EXPECT_EQ(nearestPoint(b, {5, 5}), TPoint2D(2, 1));
  EXPECT_EQ(nearestPoint(b, {1.5, 0.5}), TPoint2D(1.5, 0.5));
  EXPECT_EQ(nearestPoint(b, {2, 1}), TPoint2D(2, 1));
  const Outline c = Circle{{1, 1}, 5};
  EXPECT_EQ(nearestPoint(c, {1, 11}), TPoint2D(1, 6));
  EXPECT_EQ(nearestPoint(c, {2, 3}), TPoint2D(2, 3));
  EXPECT_EQ(nearestPoint(c, {1, 1}), TPoint2D(1, 1)) << "at the very centre there is no direction outwards";
}

TEST(NearestPoint, LiesInTheOutlineAtTheMinimumDistance) {
  Rng rng(2);
  const SolidSpread families[] = {{}, {.lattice_m = 0.25}, {.size_min_m = 0.001, .size_max_m = 100}};
  for (int i = 0; i < 60000; ++i) {
    const Outline outline = randomOutline(rng, families[i % 3]);
    const TPoint2D p = randomPoint(rng, {-12, 12, -12, 12});
    const Real expected = slowDistance(outline, real(p));
    ASSERT_NEAR(distance(outline, p), expected, 1e-9) << "case " << i;
    const TPoint2D nearest = nearestPoint(outline, p);
    ASSERT_NEAR(norm(real(nearest) - real(p)), expected, 1e-9) << "case " << i;
    ASSERT_LT(signedExcess(outline, real(nearest)), 1e-9) << "case " << i;
    if (signedExcess(outline, real(p)) < -kGrain_m) {
      ASSERT_NEAR(norm(real(nearest) - real(p)), 0, 1e-12) << "case " << i;
      ASSERT_EQ(distance(outline, p), 0) << "case " << i;
    }
  }
}

TEST(NormalAt, IsPerpendicularToTheBoundary) {
  const Outline b = OrientedBox{{1, 0}, {0.8, 0.6}, 5, 10};
  // The middles of the four faces: 5 along the axis and back, 10 across to the left and the right.
  const TPoint2D along{0.8, 0.6}, left{-0.6, 0.8};
  for (const double way : {1.0, -1.0}) {
    EXPECT_LT((normalAt(b, TPoint2D(1, 0) + along * (5 * way)) - along * way).norm(), 1e-15);
    EXPECT_LT((normalAt(b, TPoint2D(1, 0) + left * (10 * way)) - left * way).norm(), 1e-15);
  }
  EXPECT_LT((normalAt(Circle{{1, 1}, 5}, {4, 5}) - TPoint2D(0.6, 0.8)).norm(), 1e-15);
}

TEST(NormalAt, PointsFromTheNearestPointToAPointBeforeAFace) {
  Rng rng(5);
  for (int i = 0; i < 20000; ++i) {
    const Outline outline = randomOutline(rng, {.area = {-3, 3, -3, 3}});
    const TPoint2D p = randomPoint(rng, {-5, 5, -5, 5}), on_rim = nearestPoint(outline, p);
    const double away = distance(outline, p);
    if (away < 1e-3) continue;
    const TPoint2D normal = normalAt(outline, on_rim);
    ASSERT_NEAR(normal.norm(), 1, 1e-12) << "case " << i;
    if (const auto* b = std::get_if<OrientedBox>(&outline)) {
      const auto corners = cornersOf(*b);
      const bool at_corner =
          std::any_of(corners.begin(), corners.end(), [&](auto c) { return norm(c - real(on_rim)) < 1e-9; });
      if (at_corner) continue;
    }
    ASSERT_LT((normal * away - (p - on_rim)).norm(), 1e-9) << "case " << i;
  }
}

TEST(DistanceOfOutlines, IsTheDistanceOfTheirNearestPoints) {
  // Centres 5 apart (3-4-5), radii 1 and 2.
  EXPECT_NEAR(distance(Circle{{0, 0}, 1}, Circle{{3, 4}, 2}), 2, 1e-15);
  // From the circle's centre (5, 5) to the corner (2, 1): 5 again.
  EXPECT_NEAR(distance(Circle{{5, 5}, 2}, OrientedBox{{0, 0}, {1, 0}, 2, 1}), 3, 1e-15);
  // Corner (1, 1) to corner (4, 5).
  EXPECT_NEAR(distance(OrientedBox{{0, 0}, {1, 0}, 1, 1}, OrientedBox{{5, 6}, {1, 0}, 1, 1}), 5, 1e-15);
  // A unit square rotated by 45°, its corner √2/2 from its centre, before the face x = 1.
  EXPECT_NEAR(distance(box(3, 0, 1, 1, M_PI / 4).outline, box(0, 0, 2, 2).outline), 2 - std::sqrt(0.5), 1e-15);
}

TEST(DistanceOfOutlines, IsZeroForTouchingCrossingAndNestedOutlines) {
  const Outline big = box(0, 0, 10, 10).outline;
  EXPECT_EQ(distance(big, box(1, 1, 2, 2, 0.3).outline), 0) << "a box inside a box: no sides cross";
  EXPECT_EQ(distance(box(1, 1, 2, 2, 0.3).outline, big), 0);
  EXPECT_EQ(distance(big, Circle{{1, 1}, 1}), 0);
  EXPECT_EQ(distance(Circle{{1, 1}, 1}, big), 0);
  EXPECT_EQ(distance(Circle{{0, 0}, 5}, Circle{{1, 0}, 1}), 0);
  EXPECT_EQ(distance(box(0, 0, 10, 1).outline, box(0, 0, 1, 10).outline), 0) << "a plus sign: no corner in the other";
  EXPECT_EQ(distance(big, box(6, 0, 2, 2).outline), 0) << "faces touch";
  EXPECT_EQ(distance(big, box(6, 6, 2, 2).outline), 0) << "corners touch";
  EXPECT_EQ(distance(big, Circle{{7, 0}, 2}), 0);
  EXPECT_EQ(distance(Circle{{0, 0}, 2}, Circle{{3, 4}, 3}), 0);
}

TEST(DistanceOfOutlines, AgreesWithCornersAndSidesOfRandomOutlines) {
  Rng rng(3);
  const SolidSpread families[] = {
      {.area = {-3, 3, -3, 3}}, {.area = {-3, 3, -3, 3}, .lattice_m = 0.25}, {.size_min_m = 0.001, .size_max_m = 100}};
  for (int i = 0; i < 60000; ++i) {
    const Outline a = randomOutline(rng, families[i % 3]), b = randomOutline(rng, families[i % 3]);
    const double there = distance(a, b);
    ASSERT_NEAR(there, slowDistance(a, b), 1e-9) << "case " << i;
    ASSERT_NEAR(there, distance(b, a), 1e-12) << "case " << i;
  }
}

TEST(Overlap, RequiresMoreThanATouchingFace) {
  EXPECT_TRUE(overlap(disc(0, 0, 1), disc(1.99, 0, 1)));
  EXPECT_FALSE(overlap(disc(0, 0, 1), disc(2, 0, 1)));
  EXPECT_FALSE(overlap(disc(0, 0, 2), disc(3, 4, 3)));
  EXPECT_TRUE(overlap(box(0, 0, 2, 2), box(1.99, 0, 2, 2)));
  EXPECT_FALSE(overlap(box(0, 0, 2, 2), box(2, 0, 2, 2))) << "face to face";
  EXPECT_FALSE(overlap(box(0, 0, 2, 2), box(2, 1, 2, 2))) << "half of a face";
  EXPECT_FALSE(overlap(box(0, 0, 2, 2), box(2, 2, 2, 2))) << "corner to corner";
  EXPECT_FALSE(overlap(box(0, 0, 2, 2), disc(3, 0, 2)));
  EXPECT_FALSE(overlap(disc(3, 0, 2), box(0, 0, 2, 2)));
  EXPECT_TRUE(overlap(disc(2.99, 0, 2), box(0, 0, 2, 2)));
  EXPECT_TRUE(overlap(box(0, 0, 10, 1), box(0, 0, 1, 10)));
  EXPECT_TRUE(overlap(box(0, 0, 10, 10), box(1, 1, 1, 1, 0.3)));
  EXPECT_TRUE(overlap(disc(0.1, 0, 0.5), box(0, 0, 10, 10)));
  EXPECT_TRUE(overlap(disc(0, 0, 1), disc(0, 0, 1))) << "the same place";
  EXPECT_TRUE(overlap(box(0, 0, 1, 2, 0.7), box(0, 0, 1, 2, 0.7))) << "the same place";
}

TEST(Overlap, ExcludesSolidsAboveEachOther) {
  EXPECT_FALSE(overlap(disc(0, 0, 1, {0, 1}), disc(0, 0, 1, {2, 3})));
  EXPECT_FALSE(overlap(box(0, 0, 1, 1, 0, {0, 1}), disc(0, 0, 1, {1, 3}))) << "one stands on the other";
  EXPECT_TRUE(overlap(box(0, 0, 1, 1, 0, {0, 1}), disc(0, 0, 1, {0.9, 3})));
}

TEST(Overlap, AgreesWithTheDistanceOfRandomSolids) {
  Rng rng(4);
  const SolidSpread families[] = {{.area = {-2, 2, -2, 2}}, {.area = {-2, 2, -2, 2}, .lattice_m = 0.25}};
  for (int i = 0; i < 40000; ++i) {
    const bool on_lattice = i % 2 == 1;
    const Solid a = randomSolid(rng, families[i % 2]), b = randomSolid(rng, families[i % 2]);
    const bool meet_in_height = a.heights.z_min_m < b.heights.z_max_m && b.heights.z_min_m < a.heights.z_max_m;
    // Shrunk slightly, overlapping bodies still have distance 0, and those that only touch do not.
    Solid thinner = a;
    if (auto* circle = std::get_if<Circle>(&thinner.outline)) {
      circle->radius_m -= 1e-9;
    } else {
      auto& b2 = std::get<OrientedBox>(thinner.outline);
      b2.half_length_m -= 1e-9;
      b2.half_width_m -= 1e-9;
    }
    const bool deep = slowDistance(thinner.outline, b.outline) == 0;
    const bool apart = slowDistance(a.outline, b.outline) > 0;
    ASSERT_EQ(overlap(a, b), overlap(b, a)) << "case " << i;
    ASSERT_TRUE(!deep || overlap(a, b) == meet_in_height) << "case " << i;
    ASSERT_FALSE(apart && !on_lattice && overlap(a, b)) << "case " << i;
    const bool boxes = std::holds_alternative<OrientedBox>(a.outline) && std::holds_alternative<OrientedBox>(b.outline);
    // Boxes on the lattice are computed without rounding, so touching and overlapping ones are distinguished exactly.
    if (on_lattice && boxes) {
      ASSERT_EQ(overlap(a, b), deep && meet_in_height) << "case " << i;
    }
  }
}

}  // namespace
}  // namespace robosim
