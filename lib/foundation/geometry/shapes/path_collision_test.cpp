// Collisions of two discs that drive their paths simultaneously.
#include <gtest/gtest.h>

#include "geometry/shapes/path.h"
#include "geometry/testing/slow_geometry.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// From a point, towards a heading.
Path drive(double x, double y, double heading_rad, double length_m) { return {{x, y, heading_rad}, length_m, 0}; }

TEST(Collide, DetectsHeadOnCollisions) {
  // 10 apart, radii 1 and 2: they touch after 7 between them.
  EXPECT_TRUE(collide(drive(0, 0, 0, 4), 1, drive(10, 0, M_PI, 4), 2));
  EXPECT_FALSE(collide(drive(0, 0, 0, 3.4), 1, drive(10, 0, M_PI, 3.4), 2));
  EXPECT_TRUE(collide(drive(0, 0, 0, 8), 1, drive(10, 0, 0, 0), 2)) << "one is at rest";
  EXPECT_FALSE(collide(drive(0, 0, 0, 8), 1, drive(10, 0, 0, 8), 2)) << "one moves away at the same speed";
}

TEST(Collide, KeepsTheContactGap) {
  EXPECT_TRUE(collide(drive(0, 0, 0, 0), 1, drive(3 + 0.9e-6, 5, -M_PI / 2, 10), 2)) << "passing, 0.9 µm clear";
  EXPECT_FALSE(collide(drive(0, 0, 0, 0), 1, drive(3 + 1.1e-6, 5, -M_PI / 2, 10), 2)) << "passing, 1.1 µm clear";
}

TEST(Collide, RequiresTheSamePositionAtTheSameTime) {
  // At time t the first disc is at (10t, 0). The second crosses its path at (5, 0), in the middle of the step: they
  // collide. When it starts 10 farther back, at (5, 25 - 30t), then (10t - 5)² + (25 - 30t)² is minimal at t = 0.8,
  // when they are √10 apart.
  EXPECT_TRUE(collide(drive(0, 0, 0, 10), 1, drive(5, 5, -M_PI / 2, 10), 1));
  EXPECT_TRUE(collide(drive(0, 0, 0, 10), 1, drive(5, 15, -M_PI / 2, 30), 1));
  EXPECT_FALSE(collide(drive(0, 0, 0, 10), 1.58, drive(5, 25, -M_PI / 2, 30), 1.58)) << "√10 = 3.1623";
  EXPECT_TRUE(collide(drive(0, 0, 0, 10), 1.582, drive(5, 25, -M_PI / 2, 30), 1.582));
}

TEST(Collide, ConsidersThatAClippedDiscStops) {
  Path stopped = drive(0, 0, 0, 10);
  stopped.end_fraction = 0.5;
  EXPECT_TRUE(collide(stopped, 1, drive(5, 10, -M_PI / 2, 10), 1)) << "driven into after it stopped at x = 5";
  EXPECT_FALSE(collide(stopped, 1, drive(7.1, 10, -M_PI / 2, 20), 1)) << "it never gets to x = 7.1";
}

TEST(Collide, FollowsDiscsOnTheirArcs) {
  // On one circle of radius 5, a quarter apart, both drive a quarter to the left: always 5√2 apart.
  const double quarter = 5 * M_PI / 2;
  const Path ahead{{0, 5, M_PI}, quarter, M_PI / 2}, behind{{5, 0, M_PI / 2}, quarter, M_PI / 2};
  EXPECT_FALSE(collide(ahead, 3.5, behind, 3.5));
  EXPECT_TRUE(collide(ahead, 3.54, behind, 3.54)) << "5√2 / 2 = 3.5355";
  // In opposite directions they exchange positions and collide.
  EXPECT_TRUE(collide({{0, 5, 0}, quarter, -M_PI / 2}, 0.01, behind, 0.01));
}

TEST(Collide, LetsTouchingDiscsSeparateButNotApproach) {
  Rng rng(1);
  for (int i = 0; i < 20000; ++i) {
    const double a = rng.uniform(0.05, 1), b = rng.uniform(0.05, 1);
    const double way = rng.uniform(-M_PI, M_PI), apart = a + b + rng.uniform(0, 1) * kContactGap_m;
    const TPoint2D at = randomPoint(rng, {-5, 5, -5, 5});
    const TPoint2D there = at + TPoint2D(std::cos(way), std::sin(way)) * apart;
    const double length = rng.uniform(0.001, 2), aside = rng.uniform(-1.5, 1.5);
    const Path leaving = drive(there.x, there.y, way + aside, length);
    const Path entering = drive(there.x, there.y, way + M_PI + aside, length);
    const Path standing = drive(at.x, at.y, 0, 0), fleeing = drive(at.x, at.y, way + M_PI, length);
    ASSERT_FALSE(collide(leaving, b, standing, a)) << "case " << i;
    ASSERT_FALSE(collide(standing, a, leaving, b)) << "case " << i;
    ASSERT_FALSE(collide(leaving, b, fleeing, a)) << "case " << i;
    ASSERT_TRUE(collide(entering, b, standing, a)) << "case " << i;
    ASSERT_TRUE(collide(standing, a, entering, b)) << "case " << i;
  }
}

TEST(Collide, IgnoresTouchingDiscsAtRestOrInParallel) {
  const double apart = 2 + kContactGap_m / 2;
  EXPECT_FALSE(collide(drive(0, 0, 0, 0), 1, drive(0, apart, 0, 0), 1));
  EXPECT_FALSE(collide({{0, 0, 0}, 0, 1}, 1, {{0, apart, 0}, 0, -1}, 1)) << "turning on the spot";
  EXPECT_FALSE(collide(drive(0, 0, 0, 3), 1, drive(0, apart, 0, 3), 1));
}

TEST(Collide, AgreesWithASlowSearchOverRandomPaths) {
  Rng rng(2);
  int meetings = 0;
  for (int i = 0; i < 12000; ++i) {
    Path a = randomPath(rng, {-2, 2, -2, 2}), b = randomPath(rng, {-2, 2, -2, 2});
    if (rng.below(4) == 0) a.end_fraction = rng.uniform();
    if (rng.below(4) == 0) b.end_fraction = rng.uniform();
    if (rng.below(8) == 0) a.length_m = 0;
    const double radius_a = rng.uniform(0.05, 1), radius_b = rng.uniform(0.05, 1);
    const Real near = Real(radius_a) + radius_b + kContactGap_m;
    if (norm(onChords(a, 0) - onChords(b, 0)) < near + 1e-9L) continue;
    const Real nearest = slowNearest(a, b);
    const bool met = collide(a, radius_a, b, radius_b);
    ASSERT_EQ(met, collide(b, radius_b, a, radius_a)) << "case " << i;
    const bool a_hair_decides = std::abs(nearest - near) < kGrain_m;
    ASSERT_TRUE(a_hair_decides || met == (nearest < near)) << "case " << i;
    meetings += met;
  }
  EXPECT_GT(meetings, 1000);
}

}  // namespace
}  // namespace robosim
