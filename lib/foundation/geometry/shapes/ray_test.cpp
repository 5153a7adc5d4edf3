#include "geometry/shapes/ray.h"

#include <gtest/gtest.h>

#include "geometry/testing/random_scene.h"
#include "geometry/testing/slow_geometry.h"

namespace robosim {
namespace {

using mrpt::math::TPoint3D;

const Solid kBox{OrientedBox{{5, 0}, {1, 0}, 1, 2}, {0, 2}};  ///< x 4 … 6, y -2 … 2, z 0 … 2
const Solid kPillar{Circle{{5, 0}, 2}, {0, 2}};               ///< x 3 … 7

std::optional<double> cast(const TPoint3D& origin, const TPoint3D& direction, const Solid& solid) {
  return intersect(Ray{origin, direction}, solid);
}
double far(const TPoint3D& origin, const TPoint3D& direction, const Solid& solid) {
  return cast(origin, direction, solid).value_or(-1);
}

/// First position along the ray inside the solid grown by `grown_m`.
std::optional<Real> slowIntersect(const Ray& ray, const Solid& solid, Real grown_m) {
  const auto stands_out = [&](Real t) {
    const Real z = ray.origin.z + ray.direction.z * t;
    const RealPoint p{ray.origin.x + ray.direction.x * t, ray.origin.y + ray.direction.y * t};
    return std::max({signedExcess(solid.outline, p), z - solid.heights.z_max_m, solid.heights.z_min_m - z});
  };
  return firstAtMost(stands_out, 0, 1000, grown_m);
}

/// Whether the result is within 1e-9 m of the reference. Where a tolerance decides whether the ray hits the solid, any
/// result between those for a solid grown and shrunk by it is accepted; `grazes` counts these.
testing::AssertionResult isExact(const Ray& ray, const Solid& solid, int& grazes) {
  const auto fast = intersect(ray, solid);
  const auto slow = slowIntersect(ray, solid, 0);
  if (fast.has_value() == slow.has_value() && (!fast || std::abs(*fast - *slow) < 1e-9L)) {
    return testing::AssertionSuccess();
  }
  ++grazes;
  const Real never = std::numeric_limits<Real>::infinity();
  const Real first = slowIntersect(ray, solid, kGrain_m).value_or(never);
  const Real last = slowIntersect(ray, solid, -kGrain_m).value_or(never);
  const Real got = fast ? Real(*fast) : never;
  if (first - 1e-9L <= got && got <= last + 1e-9L) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "got " << got << ", expected " << slow.value_or(never) << " (" << first << " … "
                                     << last << ")";
}

TEST(Ray, PointsAlongItsAzimuthAndElevation) {
  const TPoint3D level = Ray::towards({1, 2, 3}, M_PI / 6).direction;
  EXPECT_NEAR(level.x, std::sqrt(3) / 2, 1e-15);
  EXPECT_NEAR(level.y, 0.5, 1e-15);
  EXPECT_EQ(level.z, 0);
  const TPoint3D up = Ray::towards({0, 0, 0}, M_PI / 2, M_PI / 3).direction;
  EXPECT_NEAR(up.x, 0, 1e-15);
  EXPECT_NEAR(up.y, 0.5, 1e-15);
  EXPECT_NEAR(up.z, std::sqrt(3) / 2, 1e-15);
  EXPECT_EQ((Ray{{1, 2, 3}, {0, 1, 0}}.at(4)), TPoint3D(1, 6, 3));
}

TEST(Intersect, IsTheDistanceToTheFirstFace) {
  EXPECT_EQ(far({0, 0, 1}, {1, 0, 0}, kBox), 4);
  EXPECT_EQ(far({0, 0, 1}, {1, 0, 0}, kPillar), 3);
  EXPECT_EQ(far({5, 10, 1}, {0, -1, 0}, kBox), 8);
  EXPECT_EQ(far({5, 10, 1}, {0, -1, 0}, kPillar), 8);
  // A 3-4-5 ray from the origin enters the face x = 4 at y = 3 (beyond the box), and with the box moved up there.
  EXPECT_EQ(cast({0, 0, 1}, {0.8, 0.6, 0}, kBox), std::nullopt);
  EXPECT_NEAR(far({0, 0, 1}, {0.8, 0.6, 0}, {OrientedBox{{5, 3}, {1, 0}, 1, 2}, {0, 2}}), 5, 1e-14);
}

TEST(Intersect, MissesSolidsBehindOrAside) {
  EXPECT_EQ(cast({0, 0, 1}, {-1, 0, 0}, kBox), std::nullopt);
  EXPECT_EQ(cast({0, 0, 1}, {-1, 0, 0}, kPillar), std::nullopt);
  EXPECT_EQ(cast({0, 2.001, 1}, {1, 0, 0}, kBox), std::nullopt) << "parallel to a face, a millimetre off";
  EXPECT_EQ(cast({0, 2.001, 1}, {1, 0, 0}, kPillar), std::nullopt);
  EXPECT_EQ(cast({0, 0, 1}, {0, 1, 0}, kBox), std::nullopt) << "parallel to the near face";
}

TEST(Intersect, IsZeroFromInsideAndFromTheSurface) {
  for (const TPoint3D& direction : {TPoint3D(1, 0, 0), TPoint3D(-1, 0, 0), TPoint3D(0, 0, 1), TPoint3D(0.6, 0, -0.8)}) {
    EXPECT_EQ(cast({5, 0, 1}, direction, kBox), 0);
    EXPECT_EQ(cast({5, 0, 1}, direction, kPillar), 0);
    EXPECT_EQ(cast({4, 0, 1}, direction, kBox), 0) << "on a face";
    EXPECT_EQ(cast({4, 2, 2}, direction, kBox), 0) << "on a corner";
    EXPECT_EQ(cast({3, 0, 1}, direction, kPillar), 0);
    EXPECT_EQ(cast({5, 0, 2}, direction, kPillar), 0) << "on the lid";
  }
}

TEST(Intersect, HitsTouchedSolids) {
  EXPECT_EQ(far({0, 2, 1}, {1, 0, 0}, kBox), 4) << "along a face";
  EXPECT_EQ(far({0, -2, 1}, {1, 0, 0}, kBox), 4);
  EXPECT_EQ(far({4, 10, 1}, {0, -1, 0}, kBox), 8) << "along the near face";
  EXPECT_EQ(far({0, 2, 1}, {1, 0, 0}, kPillar), 5) << "a tangent, at x = 5";
  EXPECT_EQ(far({0, 2, 2}, {1, 0, 0}, kBox), 4) << "along the upper edge";
  EXPECT_EQ(far({0, 0, 0}, {1, 0, 0}, kBox), 4) << "along the underside";
  EXPECT_EQ(far({0, 0, 2}, {1, 0, 0}, kPillar), 3) << "along the lid";
  // Through the corner (4, 2) only, diagonally: from (1, 5), 3√2 away.
  const double s = std::sqrt(0.5);
  EXPECT_NEAR(far({1, -1, 1}, {s, s, 0}, kBox), std::sqrt(18), 1e-14) << "through a corner and out beside the box";
}

TEST(Intersect, ConsidersHeightsAlongTheRay) {
  EXPECT_EQ(cast({0, 0, 2.001}, {1, 0, 0}, kBox), std::nullopt) << "over it";
  EXPECT_EQ(cast({0, 0, -0.001}, {1, 0, 0}, kBox), std::nullopt) << "under it";
  EXPECT_EQ(cast({0, 0, 2.001}, {1, 0, 0}, kPillar), std::nullopt);
  EXPECT_EQ(cast({5, 0, 2.001}, {1, 0, 0}, kPillar), std::nullopt) << "above its middle is not inside";
  // Down by 3 in 4: at the face x = 4 the beam is 3 lower. From 4 high it enters there, at 1; from 6 high it is then at
  // 3 and hits the top (z = 2) at x = 16/3, 20/3 along; from 8 high it passes over the whole box.
  EXPECT_NEAR(far({0, 0, 4}, {0.8, 0, -0.6}, kBox), 5, 1e-14);
  EXPECT_NEAR(far({0, 0, 6}, {0.8, 0, -0.6}, kBox), 20.0 / 3, 1e-14);
  EXPECT_EQ(cast({0, 0, 8}, {0.8, 0, -0.6}, kBox), std::nullopt);
  // Up by 3 in 4: from 4 below it goes through the underside (z = 0) at x = 16/3; from 6 below it passes under the box.
  EXPECT_NEAR(far({0, 0, -4}, {0.8, 0, 0.6}, kBox), 20.0 / 3, 1e-14);
  EXPECT_EQ(cast({0, 0, -6}, {0.8, 0, 0.6}, kBox), std::nullopt);
}

TEST(Intersect, HitsTopAndUndersideVertically) {
  EXPECT_EQ(far({5, 1, 10}, {0, 0, -1}, kBox), 8);
  EXPECT_EQ(far({5, 1, -3}, {0, 0, 1}, kPillar), 3);
  EXPECT_EQ(far({4, 2, 10}, {0, 0, -1}, kBox), 8) << "down the corner";
  EXPECT_EQ(far({3, 0, 10}, {0, 0, -1}, kPillar), 8) << "down the side";
  EXPECT_EQ(cast({3.99, 0, 10}, {0, 0, -1}, kBox), std::nullopt);
  EXPECT_EQ(cast({2.99, 0, 10}, {0, 0, -1}, kPillar), std::nullopt);
  EXPECT_EQ(cast({5, 1, 10}, {0, 0, 1}, kBox), std::nullopt) << "away";
}

TEST(SpanInside, IsThePartOfTheLineBetweenTwoFaces) {
  const auto span = [](const TPoint3D& origin, const TPoint3D& direction, const Solid& solid) {
    const auto found = spanInside({origin, direction}, solid);
    return found ? std::pair(found->from_m, found->to_m) : std::pair(0.0, 0.0);
  };
  EXPECT_EQ(span({0, 0, 1}, {1, 0, 0}, kBox), std::pair(4.0, 6.0));
  EXPECT_EQ(span({0, 0, 1}, {1, 0, 0}, kPillar), std::pair(3.0, 7.0));
  EXPECT_EQ(span({10, 0, 1}, {1, 0, 0}, kBox), std::pair(-6.0, -4.0)) << "behind the origin";
  EXPECT_EQ(span({5, 0, 5}, {0, 0, -1}, kBox), std::pair(3.0, 5.0)) << "down";
  EXPECT_EQ(span({0, 2, 1}, {1, 0, 0}, kBox), std::pair(4.0, 6.0)) << "along a face";
  EXPECT_EQ(span({0, 2, 1}, {1, 0, 0}, kPillar), std::pair(5.0, 5.0)) << "a tangent";
  // Down by 3 in 4 from z = 4: below the top, z = 2, from 10/3 on, inside x = 4 … 6 from 5 to 7.5, above z = 0 to 20/3.
  const auto [from_m, to_m] = span({0, 0, 4}, {0.8, 0, -0.6}, kBox);
  EXPECT_NEAR(from_m, 5, 1e-14);
  EXPECT_NEAR(to_m, 20.0 / 3, 1e-14);
  EXPECT_FALSE(spanInside({{0, 2.001, 1}, {1, 0, 0}}, kBox));
  EXPECT_FALSE(spanInside({{0, 0, 2.001}, {1, 0, 0}}, kPillar));
}

TEST(Intersect, AgreesWithBisectionOverRandomSolids) {
  Rng rng(1);
  const SolidSpread families[] = {
      {.area = {-4, 4, -4, 4}}, {.area = {-4, 4, -4, 4}, .lattice_m = 0.25}, {.size_min_m = 0.001, .size_max_m = 100}};
  int grazes = 0, hits = 0;
  for (int i = 0; i < 30000; ++i) {
    const Solid solid = randomSolid(rng, families[i % 3]);
    const Bounds2D from{-8, 8, -8, 8};
    Ray ray = i % 2 ? randomRay(rng, from, -1, 3) : randomPlanarRay(rng, from, -0.2, 2.2);
    if (i % 4 < 2) {
      // Half of the rays are aimed at the solid, or close to it.
      const Bounds2D b = boundsOf(solid.outline);
      const double dx = rng.uniform(b.x_min, b.x_max) - ray.origin.x, dy = rng.uniform(b.y_min, b.y_max) - ray.origin.y;
      const double z = rng.uniform(solid.heights.z_min_m, solid.heights.z_max_m);
      if (i % 2 == 0) ray.origin.z = z;
      const double dz = z - ray.origin.z;
      ray = Ray::towards(ray.origin, std::atan2(dy, dx), std::atan2(dz, std::hypot(dx, dy)));
    }
    ASSERT_TRUE(isExact(ray, solid, grazes)) << "case " << i;
    hits += intersect(ray, solid).has_value();
  }
  EXPECT_GT(hits, 10000);
  EXPECT_LT(grazes, 10) << "grazing is rare";
}

TEST(Intersect, AgreesWithBisectionAtCornersEdgesAndTangents) {
  Rng rng(2);
  int grazes = 0;
  for (int i = 0; i < 20000; ++i) {
    const Solid solid = randomSolid(rng, {.area = {-4, 4, -4, 4}, .lattice_m = i % 2 ? 0.25 : 0});
    const TPoint3D from = randomRay(rng, {-8, 8, -8, 8}, -1, 3).origin;
    RealPoint target;
    if (const auto* circle = std::get_if<Circle>(&solid.outline)) {
      const Real turn = rng.uniform(-M_PI, M_PI);
      target = real(circle->center) + RealPoint{std::cos(turn), std::sin(turn)} * circle->radius_m;
    } else {
      const auto corners = cornersOf(std::get<OrientedBox>(solid.outline));
      const std::uint32_t k = rng.below(4);
      target = rng.below(2) ? corners[k] : corners[k] + (corners[(k + 1) % 4] - corners[k]) * rng.uniform();
    }
    const double dx = double(target.x) - from.x, dy = double(target.y) - from.y;
    const double z = rng.below(2) ? solid.heights.z_min_m : solid.heights.z_max_m;
    const double elevation = rng.below(2) ? std::atan2(z - from.z, std::hypot(dx, dy)) : 0;
    ASSERT_TRUE(isExact(Ray::towards(from, std::atan2(dy, dx), elevation), solid, grazes)) << "case " << i;
  }
}

TEST(Intersect, CountsEveryTouchOnALatticeWhereNothingIsRounded) {
  Rng rng(3);
  int touches = 0;
  for (int i = 0; i < 20000; ++i) {
    const Solid solid = randomSolid(rng, {.area = {-3, 3, -3, 3}, .lattice_m = 0.5});
    const Bounds2D b = boundsOf(solid.outline);
    // Along x, from lattice points, at lattice heights.
    const double x = -8, y = 0.5 * (double(rng.below(17)) - 8), z = 0.5 * rng.below(5);
    const bool meets = b.y_min <= y && y <= b.y_max && solid.heights.contains(z);
    touches += meets && (y == b.y_min || y == b.y_max || z == solid.heights.z_min_m || z == solid.heights.z_max_m);
    double enters = b.x_min;
    if (const auto* circle = std::get_if<Circle>(&solid.outline)) {
      const double dy = y - circle->center.y;
      enters = circle->center.x - std::sqrt(std::max(0.0, circle->radius_m * circle->radius_m - dy * dy));
    }
    const auto along_x = cast({x, y, z}, {1, 0, 0}, solid);
    ASSERT_EQ(along_x.has_value(), meets) << "case " << i;
    if (meets) {
      ASSERT_NEAR(*along_x, enters - x, 1e-12) << "case " << i;
    }
    // And in the opposite direction: the world mirrored in x.
    Solid mirrored = solid;
    std::visit([](auto& o) { o.center.x = -o.center.x; }, mirrored.outline);
    ASSERT_EQ(cast({-x, y, z}, {-1, 0, 0}, mirrored), along_x) << "case " << i;
  }
  EXPECT_GT(touches, 1000);
}

}  // namespace
}  // namespace robosim
