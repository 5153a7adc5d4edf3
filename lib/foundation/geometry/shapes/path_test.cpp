#include "geometry/shapes/path.h"

#include <vector>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/random.h"
#include "geometry/shapes/chord_batch.h"
#include "geometry/testing/random_scene.h"
#include "geometry/testing/slow_geometry.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// Distance of the disc's boundary to the outline at a fraction of the step; < 0 when they overlap.
double clearance(const Path& path, double fraction, double radius_m, const Outline& outline) {
  return distance(outline, path.centerAt(fraction)) - radius_m;
}

TEST(Path, GoesStraightWhenItDoesNotTurn) {
  const Path path{{1, 2, M_PI / 2}, 4, 0};
  EXPECT_NEAR(path.centerAt(0.25).x, 1, 1e-15);
  EXPECT_NEAR(path.centerAt(0.25).y, 3, 1e-15);
  const Path back{{1, 2, 0}, -4, 0};
  EXPECT_EQ(back.centerAt(0.5), TPoint2D(-1, 2));
  EXPECT_EQ(back.centerAt(0), TPoint2D(1, 2));
}

TEST(Path, EndsAQuarterCircleWhereTheCircleEnds) {
  // Radius 2, to the left from (0, 0) along x: ends at (2, 2), heading along y. Halfway at 2 (sin 45°, 1 - cos 45°).
  const Path left{{0, 0, 0}, M_PI, M_PI / 2};
  EXPECT_NEAR(left.endPose().x, 2, 1e-14);
  EXPECT_NEAR(left.endPose().y, 2, 1e-14);
  EXPECT_NEAR(left.endPose().phi, M_PI / 2, 1e-15);
  EXPECT_NEAR(left.centerAt(0.5).x, std::sqrt(2), 1e-14);
  EXPECT_NEAR(left.centerAt(0.5).y, 2 - std::sqrt(2), 1e-14);
  // Backwards with the same turn: the circle's centre is still at its left, (0, 2).
  const TPose2D back = Path{{0, 0, 0}, -M_PI, -M_PI / 2}.endPose();
  EXPECT_NEAR(back.x, -2, 1e-14);
  EXPECT_NEAR(back.y, 2, 1e-14);
  EXPECT_NEAR(back.phi, -M_PI / 2, 1e-15);
}

TEST(Path, TurnsOnTheSpotWithoutLeavingIt) {
  const Path spin{{3, 4, 3}, 0, 1};
  EXPECT_EQ(spin.centerAt(0.3), TPoint2D(3, 4));
  EXPECT_NEAR(spin.endPose().phi, 4 - 2 * M_PI, 1e-14) << "headings lie within (-π, π]";
}

TEST(Path, StopsTheCentreAtEndFractionButCompletesTheTurn) {
  Path path{{0, 0, 0}, M_PI, M_PI / 2};
  path.end_fraction = 1.0 / 3;  // 30° of the quarter circle of radius 2: a chord's end
  EXPECT_NEAR(path.endPose().x, 1, 1e-14);
  EXPECT_NEAR(path.endPose().y, 2 - std::sqrt(3), 1e-14);
  EXPECT_NEAR(path.endPose().phi, M_PI / 2, 1e-15);
  EXPECT_EQ(path.centerAt(0.9), path.centerAt(1.0 / 3));
  EXPECT_NEAR(path.clippedLength(), M_PI / 3, 1e-15);
}

TEST(Path, FollowsTheArcInChordsOfAtMostThreeDegrees) {
  EXPECT_EQ((Path{{0, 0, 0}, 1, 0}.chords()), 1);
  for (double turn : {0.001, -0.05, 0.06, M_PI, -6.0, 20.0}) {
    const Path path{{1, 2, 3}, 0.7, turn};
    const int n = path.chords();
    EXPECT_LE(std::abs(turn) / n, 3 * kRadPerDeg + 1e-12) << turn;
    for (int k = 0; k < n; ++k) {
      const RealPoint a = onArc(path, Real(k) / n), b = onArc(path, Real(k + 1) / n);
      ASSERT_LT(norm(real(path.centerAt(double(k) / n)) - a), 1e-13) << turn << ", end " << k;
      ASSERT_LT(norm(real(path.centerAt((k + 0.25) / n)) - (a + (b - a) * 0.25L)), 1e-13) << turn << ", chord " << k;
    }
  }
  // An arc of radius 1 m bulges over a chord of 3° by 1 - cos 1.5° = 0.343 mm.
  const Path path{{0, 0, 0}, M_PI / 2, M_PI / 2};
  const double middle = 0.5 / path.chords();
  EXPECT_LT(norm(real(path.centerAt(middle)) - onArc(path, middle)), 0.4e-3);
}

TEST(Path, EndsWhereTheExactArcEnds) {
  Rng rng(1);
  for (int i = 0; i < 20000; ++i) {
    const Path path = randomPath(rng, {-10, 10, -10, 10});
    const TPose2D end = path.endPose();
    ASSERT_LT(norm(RealPoint{end.x, end.y} - onArc(path, 1)), 1e-11) << "case " << i;
    const double off = end.phi - path.world_from_start.phi - path.turn_rad;
    ASSERT_NEAR(std::remainder(off, 2 * M_PI), 0, 1e-12) << "case " << i;
    ASSERT_GT(end.phi, -M_PI) << "case " << i;
    ASSERT_LE(end.phi, M_PI) << "case " << i;
  }
}

TEST(FirstContact, StopsAMicrometreBeforeTheWall) {
  // The wall's face is x = 3; a disc of radius 1 touches it when its centre is at x = 2.
  const Outline wall = OrientedBox{{3.5, 0}, {1, 0}, 0.5, 50};
  EXPECT_NEAR(firstContact({{0, 0, 0}, 4, 0}, 1, wall) * 4, 2 - kContactGap_m, 1e-12);
  EXPECT_NEAR(firstContact({{0, 0, M_PI}, -4, 0}, 1, wall) * 4, 2 - kContactGap_m, 1e-12) << "backwards";
  EXPECT_NEAR(firstContact({{0, 0, 60 * kRadPerDeg}, 8, 0}, 1, wall) * 8 * 0.5, 2 - kContactGap_m, 1e-12) << "aslant";
  EXPECT_EQ(firstContact({{0, 0, 0}, 1.9, 0}, 1, wall), 1) << "too short to reach it";
  EXPECT_EQ(firstContact({{0, 0, M_PI}, 4, 0}, 1, wall), 1) << "away from it";
  EXPECT_EQ(firstContact({{0, 0, M_PI / 2}, 40, 0}, 1, wall), 1) << "along it";
  EXPECT_EQ(firstContact({{0, 0, 0}, 0, 1}, 1, wall), 1) << "turning on the spot";
  EXPECT_EQ(firstContact({{0, 0, 0}, 0, 0}, 1, wall), 1) << "standing";
}

TEST(FirstContact, DetectsContactWithCornersAndCircles) {
  // Past the corner (3, 1) with the centre on y = 0.4: 0.6 below it, so a disc of radius 1 touches 0.8 before it.
  const Outline wall = OrientedBox{{4, 6}, {1, 0}, 1, 5};
  EXPECT_NEAR(firstContact({{0, 0.4, 0}, 4, 0}, 1, wall) * 4, 2.2, 2e-6);
  EXPECT_EQ(firstContact({{0, -0.001, 0}, 4, 0}, 1, wall), 1) << "a millimetre under the corner";
  // Centres on y = 0 and y = 3, radii 1 and 4: they touch 4 apart in x (3-4-5).
  EXPECT_NEAR(firstContact({{0, 0, 0}, 10, 0}, 1, Circle{{9, 3}, 4}) * 10, 5, 2e-6);
  EXPECT_EQ(firstContact({{0, 0, 0}, 20, 0}, 1, Circle{{9, 5.001}, 4}), 1);
}

TEST(FirstContact, IgnoresThePathBeyondItsEnd) {
  const Outline wall = OrientedBox{{3.5, 0}, {1, 0}, 0.5, 50};
  Path path{{0, 0, 0}, 4, 0};
  path.end_fraction = 0.49;
  EXPECT_EQ(firstContact(path, 1, wall), 1);
  path.end_fraction = 0.51;
  EXPECT_NEAR(firstContact(path, 1, wall) * 4, 2 - kContactGap_m, 1e-12);
}

TEST(FirstContact, AgreesWithASlowSearchOverRandomPaths) {
  Rng rng(2);
  int contacts = 0;
  for (int i = 0; i < 20000; ++i) {
    Path path = randomPath(rng, {-2, 2, -2, 2});
    if (i % 4 == 0) path.end_fraction = rng.uniform();
    const double radius = rng.uniform(0.05, 1);
    const Outline outline = randomOutline(rng, {.area = {-2, 2, -2, 2}, .lattice_m = i % 3 ? 0 : 0.25});
    if (clearance(path, 0, radius, outline) < 2 * kContactGap_m) continue;
    const double fast = firstContact(path, radius, outline);
    const double length = std::abs(path.length_m);
    const Real exact = slowFirstContact(path, radius, outline, 0).value_or(1);
    if (std::abs(fast - exact) * length >= 1e-9L) {
      // A tolerance decides whether the boundary just touches: both results are accepted.
      const Real first = slowFirstContact(path, radius, outline, kGrain_m).value_or(1);
      const Real last = slowFirstContact(path, radius, outline, -kGrain_m).value_or(1);
      ASSERT_GE(fast * length, first * length - 1e-9L) << "case " << i << ", exactly " << exact;
      ASSERT_LE(fast * length, last * length + 1e-9L) << "case " << i << ", exactly " << exact;
    }
    contacts += fast < 1;
    Path stopped = path;
    stopped.end_fraction = std::min(path.end_fraction, fast);
    for (int k = 0; k <= 50; ++k) {
      ASSERT_GT(clearance(stopped, k / 50.0, radius, outline), kContactGap_m - 1e-9) << "case " << i << ", " << k;
    }
  }
  EXPECT_GT(contacts, 1000);
}

TEST(FirstContact, IsNoLaterForALargerDisc) {
  Rng rng(3);
  for (int i = 0; i < 5000; ++i) {
    const Path path = randomPath(rng, {-4, 4, -4, 4});
    const Outline outline = randomOutline(rng, {.area = {-4, 4, -4, 4}});
    const double small = rng.uniform(0.05, 0.5), large = small + rng.uniform(0, 0.5);
    if (clearance(path, 0, large, outline) < 2 * kContactGap_m) continue;
    const double length = std::abs(path.length_m);
    ASSERT_LE(firstContact(path, large, outline) * length, firstContact(path, small, outline) * length + 1e-9)
        << "case " << i;
  }
}

TEST(FirstContact, NeverLetsADiscThroughAThinWall) {
  Rng rng(4);
  for (int i = 0; i < 5000; ++i) {
    // A wall across x = 0 of decreasing thickness, and discs that drive up to 10 km per step.
    const double thickness = std::pow(10, rng.uniform(-9, -2)), length = std::pow(10, rng.uniform(0, 4));
    const Outline wall = OrientedBox::from({0, 0, M_PI / 2}, 1e6, thickness);
    const double radius = std::pow(10, rng.uniform(-3, 0));
    Path path{{-radius - thickness - 2 * kContactGap_m - rng.uniform(0, 2), 0, rng.uniform(-M_PI, M_PI)}, length, 0};
    if (i % 2) path.turn_rad = rng.uniform(-6.5, 6.5);
    path.end_fraction = firstContact(path, radius, wall);
    for (int k = 0; k <= 100; ++k) {
      const double x = path.centerAt(k / 100.0).x;
      ASSERT_LT(x, -radius - thickness / 2) << "case " << i;
    }
  }
}

/// Centre of a disc that touches the outline with a distance of `gap`, and the direction straight away from it.
struct Touching {
  TPoint2D center, out;
};
Touching touching(Rng& rng, const Outline& outline, double radius_m, double gap_m) {
  for (;;) {
    const TPoint2D p = randomPoint(rng, {-9, 9, -9, 9});
    const double away = distance(outline, p);
    if (away < 0.1) continue;
    const TPoint2D at = nearestPoint(outline, p), out = (p - at) * (1 / away);
    return {at + out * (radius_m + gap_m), out};
  }
}

TEST(FirstContact, LetsATouchingDiscLeaveButNotComeNearer) {
  Rng rng(5);
  for (int i = 0; i < 20000; ++i) {
    const Outline outline = randomOutline(rng, {.area = {-4, 4, -4, 4}});
    const double radius = rng.uniform(0.05, 1), length = rng.uniform(0.001, 2);
    const Touching at = touching(rng, outline, radius, rng.uniform(0, 1) * kContactGap_m);
    const double out = std::atan2(at.out.y, at.out.x), aside = rng.uniform(-89, 89) * kRadPerDeg;
    ASSERT_EQ(firstContact({{at.center.x, at.center.y, out + aside}, length, 0}, radius, outline), 1) << "case " << i;
    ASSERT_EQ(firstContact({{at.center.x, at.center.y, out + aside}, -length, 0}, radius, outline), 0) << "case " << i;
    ASSERT_EQ(firstContact({{at.center.x, at.center.y, out + aside}, 0, 1}, radius, outline), 1) << "on the spot";
  }
}

TEST(FirstContact, LetsATouchingDiscSlideAlongAFace) {
  const Outline wall = OrientedBox{{0, -1}, {1, 0}, 100, 1};
  for (double gap : {0.0, 0.3e-6, 1e-6}) {
    EXPECT_EQ(firstContact({{0, 0.5 + gap, 0}, 10, 0}, 0.5, wall), 1) << gap;
    EXPECT_EQ(firstContact({{0, 0.5 + gap, 0}, -10, 0}, 0.5, wall), 1) << gap;
  }
}

TEST(FirstContact, StopsATouchingDiscThatLeavesAndComesBack) {
  // Straight away from the wall and around in a circle: in its second half, the circle returns to its start.
  const Outline wall = OrientedBox{{0, -1}, {1, 0}, 100, 1};
  const Path circle{{0, 0.5 + kContactGap_m / 2, M_PI / 2}, 2 * M_PI, 2 * M_PI};
  const double back = firstContact(circle, 0.5, wall);
  EXPECT_GT(back, 0.4999);
  EXPECT_LE(back, 0.5);
  EXPECT_GT(clearance(circle, back, 0.5, wall), kContactGap_m / 2 - 1e-12);
}

TEST(FirstContact, KeepsADiscClearUnderRepeatedContact) {
  Rng rng(6);
  for (int scene = 0; scene < 100; ++scene) {
    // A room of 4 m × 4 m with obstacles.
    std::vector<Outline> outlines{OrientedBox{{2.5, 0}, {1, 0}, 0.5, 9}, OrientedBox{{-2.5, 0}, {1, 0}, 0.5, 9},
                                  OrientedBox{{0, 2.5}, {1, 0}, 9, 0.5}, OrientedBox{{0, -2.5}, {1, 0}, 9, 0.5}};
    const double radius = 0.3;
    TPose2D pose{0, 0, 0};
    while (outlines.size() < 12) {
      const Outline outline = randomOutline(rng, {.area = {-2, 2, -2, 2}, .size_min_m = 0.2});
      if (distance(outline, TPoint2D(0, 0)) > radius + 2 * kContactGap_m) outlines.push_back(outline);
    }
    int stops = 0;
    for (int step = 0; step < 500; ++step) {
      Path path{pose, rng.uniform(-0.1, 0.5), rng.uniform(-1, 1)};
      for (const Outline& outline : outlines) {
        path.end_fraction = std::min(path.end_fraction, firstContact(path, radius, outline));
      }
      stops += path.end_fraction < 1;
      pose = path.endPose();
      for (const Outline& outline : outlines) {
        ASSERT_GT(distance(outline, TPoint2D(pose.x, pose.y)) - radius, 0.999 * kContactGap_m)
            << "scene " << scene << ", step " << step;
      }
    }
    EXPECT_GT(stops, 50) << "scene " << scene;
  }
}

// A disc that drives towards the edge of an area from inside.

constexpr Bounds2D kSurface{-2, 3, -1, 4};

TEST(FirstExit, StopsTheBoundaryAMicrometreBeforeTheEdge) {
  // With radius 0.5 the centre can reach x = 2.5, y = 3.5, x = -1.5 and y = -0.5, less the gap.
  EXPECT_NEAR(firstExit({{0, 0, 0}, 10, 0}, 0.5, kSurface) * 10, 2.5 - kContactGap_m, 1e-12);
  EXPECT_NEAR(firstExit({{0, 0, M_PI / 2}, 10, 0}, 0.5, kSurface) * 10, 3.5 - kContactGap_m, 1e-12);
  EXPECT_NEAR(firstExit({{0, 0, 0}, -10, 0}, 0.5, kSurface) * 10, 1.5 - kContactGap_m, 1e-12);
  EXPECT_NEAR(firstExit({{0, 0, -M_PI / 2}, 10, 0}, 0.5, kSurface) * 10, 0.5 - kContactGap_m, 1e-12);
  EXPECT_EQ(firstExit({{0, 0, 0}, 2.4, 0}, 0.5, kSurface), 1) << "too short to reach it";
  EXPECT_EQ(firstExit({{0, 0, 0}, 0, 3}, 0.5, kSurface), 1) << "turning on the spot";
  Path path{{0, 0, 0}, 10, 0};
  path.end_fraction = 0.2;
  EXPECT_EQ(firstExit(path, 0.5, kSurface), 1) << "no farther than the path's end";
}

TEST(FirstExit, LetsADiscAtOrBeyondTheEdgeOnlyReturnOrSlide) {
  for (double x : {2.5 - kContactGap_m, 2.5, 2.9, 7.0}) {
    EXPECT_EQ(firstExit({{x, 0, M_PI}, 0.5, 0}, 0.5, kSurface), 1) << x;
    EXPECT_EQ(firstExit({{x, 0, M_PI / 2}, 0.5, 0}, 0.5, kSurface), 1) << x;
    EXPECT_NEAR(firstExit({{x, 0, 0}, 0.5, 0}, 0.5, kSurface), 0, 1e-12) << x;
    EXPECT_NEAR(firstExit({{x, 0, 0.1}, 0.5, 0}, 0.5, kSurface), 0, 1e-12) << x;
  }
}

TEST(FirstExit, AgreesWithASlowSearchOverRandomPaths) {
  Rng rng(1);
  int exits = 0;
  for (int i = 0; i < 20000; ++i) {
    Path path = randomPath(rng, kSurface);
    if (i % 4 == 0) path.end_fraction = rng.uniform();
    const double radius = rng.uniform(0.01, 1);
    if (excessBeyond(kSurface, path, radius, 0) > -1e-9L) continue;
    const double fast = firstExit(path, radius, kSurface);
    const Real slow = slowFirstExit(path, radius, kSurface).value_or(1);
    ASSERT_LT(std::abs(fast - slow) * std::abs(path.length_m), 1e-9L) << "case " << i;
    exits += fast < 1;
  }
  EXPECT_GT(exits, 1000);
}

TEST(Path, EndPosesOfManyPathsAreThoseOfEach) {
  Rng rng(1);
  for (std::size_t count = 0; count <= ChordBatch::kCapacity; ++count) {
    std::vector<Path> paths(count);
    std::vector<const Path*> pointers;
    std::vector<mrpt::math::TPose2D> poses(count);
    std::vector<mrpt::math::TPose2D*> to;
    for (std::size_t i = 0; i < count; ++i) {
      Path& path = paths[i];
      path.world_from_start = {rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-M_PI, M_PI)};
      if (rng.below(4) > 0) path.length_m = rng.uniform(-0.1, 0.1);
      if (rng.below(2) == 0) path.turn_rad = rng.uniform(-0.4, 0.4);
      if (rng.below(4) == 0) path.end_fraction = rng.uniform();
      if (rng.below(4) == 0) path.direction_rad = rng.uniform(-1, 1);
      path.turn_stops = rng.below(4) == 0;
      pointers.push_back(&path);
      to.push_back(&poses[i]);
    }
    computeEndPoses(pointers, to);
    for (std::size_t i = 0; i < count; ++i) {
      const auto expected = paths[i].endPose();
      ASSERT_EQ(poses[i].x, expected.x) << i << " of " << count;
      ASSERT_EQ(poses[i].y, expected.y);
      ASSERT_EQ(poses[i].phi, expected.phi);
    }
  }
}

}  // namespace
}  // namespace robosim
