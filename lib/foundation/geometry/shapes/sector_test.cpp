#include "geometry/shapes/sector.h"

#include <vector>

#include <gtest/gtest.h>

#include "geometry/testing/slow_geometry.h"
#include "geometry/testing/slow_scene.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double k10Deg = M_PI / 18;
constexpr double k45Deg = M_PI / 4;
const HeightSpan kHigh{0, 2};

Solid highDisc(double x, double y, double radius_m) { return {Circle{{x, y}, radius_m}, kHigh}; }
Solid highBox(double x, double y, double length_m, double width_m, double turn_rad = 0) {
  return {OrientedBox::from({x, y, turn_rad}, length_m, width_m), kHigh};
}

/// Parameters of a Sector.
struct View {
  mrpt::math::TPoint3D apex;
  double axis_rad = 0, half_width_rad = 0;
};
Hit nearestIn(const View& view, const Solid& solid) {
  const Scene scene({solid}, 0, {-8, 8, -8, 8});
  return senseSector(scene, Sector::towards(view.apex, view.axis_rad, view.half_width_rad), INFINITY);
}
/// Sector from the origin along x.
View ahead(double half_width_rad, double z = 1) { return {{0, 0, z}, 0, half_width_rad}; }

void expectHit(const View& view, const Solid& solid, double distance_m, const TPoint2D& point) {
  const Hit hit = nearestIn(view, solid);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit.distance_m, distance_m, 1e-13);
  EXPECT_NEAR(hit.point.x, point.x, 1e-13);
  EXPECT_NEAR(hit.point.y, point.y, 1e-13);
}

/// Angle from `a` to `b`, in [-π, π].
Real angleBetween(RealPoint a, RealPoint b) { return std::atan2(cross(a, b), dot(a, b)); }

/// Clips the box's polygon at the sector's two edges, and takes the nearest point of the rest.
std::optional<Real> slowNearest(const View& view, const OrientedBox& box, Real wider_rad) {
  const RealPoint apex{view.apex.x, view.apex.y};
  if (signedExcess(box, apex) <= 0) return 0;
  const auto corners = cornersOf(box);
  std::vector<RealPoint> polygon(corners.begin(), corners.end());
  for (const Real side : {-1.0L, 1.0L}) {
    const Real turn = view.axis_rad + side * (view.half_width_rad + wider_rad);
    const RealPoint edge{std::cos(turn), std::sin(turn)};
    const auto inwards = [&](RealPoint p) { return -side * cross(edge, p - apex); };
    std::vector<RealPoint> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const RealPoint p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      const Real in_p = inwards(p), in_q = inwards(q);
      if (in_p >= 0) left.push_back(p);
      if ((in_p < 0) != (in_q < 0)) left.push_back(p + (q - p) * (in_p / (in_p - in_q)));
    }
    polygon = left;
  }
  if (polygon.empty()) return std::nullopt;
  Real nearest = norm(polygon[0] - apex);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const RealPoint p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    if (norm(q - p) > 0) nearest = std::min(nearest, slowDistanceToSegment(apex, p, q));
  }
  return nearest;
}

/// Grows a circle about the apex until its part within the disc, seen from the apex, reaches the sector: that part
/// spans acos((r² + d² - R²) / 2rd) to either side of the disc's centre.
std::optional<Real> slowNearest(const View& view, const Circle& circle, Real wider_rad) {
  const RealPoint to_center = real(circle.center) - RealPoint{view.apex.x, view.apex.y};
  const Real d = norm(to_center), radius = circle.radius_m;
  if (d <= radius) return 0;
  const RealPoint axis{std::cos(Real(view.axis_rad)), std::sin(Real(view.axis_rad))};
  const Real aside = std::abs(angleBetween(axis, to_center)) - (view.half_width_rad + wider_rad);
  if (aside <= 0) return d - radius;
  if (aside > std::asin(radius / d)) return std::nullopt;
  const auto reaches = [&](Real r) { return std::acos((r * r + d * d - radius * radius) / (2 * r * d)) >= aside; };
  Real within = std::sqrt(d * d - radius * radius), before = d - radius;
  for (int round = 0; round < 80; ++round) {
    const Real middle = (before + within) / 2;
    (reaches(middle) ? within : before) = middle;
  }
  return within;
}

std::optional<Real> slowNearest(const View& view, const Solid& solid, Real hair) {
  if (!solid.heights.contains(view.apex.z)) return std::nullopt;
  // The tolerance rotates the sector's edges and grows the solid.
  if (auto circle = std::get_if<Circle>(&solid.outline)) {
    return slowNearest(view, {circle->center, double(circle->radius_m + hair)}, hair);
  }
  OrientedBox grown = std::get<OrientedBox>(solid.outline);
  grown.half_length_m += double(hair);
  grown.half_width_m += double(hair);
  return slowNearest(view, grown, hair);
}

/// Whether the result is within 1e-9 m of the reference, or, where a tolerance decides whether the sector's edge hits
/// the solid, between those for solid and sector grown and shrunk by it; `grazes` counts these.
testing::AssertionResult isExact(const View& view, const Solid& solid, int& grazes) {
  const Hit fast = nearestIn(view, solid);
  const auto slow = slowNearest(view, solid, 0);
  const Real never = std::numeric_limits<Real>::infinity();
  const Real got = fast ? Real(fast.distance_m) : never;
  if (bool(fast) != slow.has_value() || (fast && std::abs(got - *slow) >= 1e-9L)) {
    ++grazes;
    const Real first = slowNearest(view, solid, kGrain_m).value_or(never);
    const Real last = slowNearest(view, solid, -kGrain_m).value_or(never);
    if (got < first - 1e-9L || got > last + 1e-9L) {
      return testing::AssertionFailure() << "got " << got << ", expected " << slow.value_or(never) << " (" << first
                                         << " … " << last << ")";
    }
  }
  if (!fast) return testing::AssertionSuccess();
  const TPoint2D point(fast.point.x, fast.point.y);
  const RealPoint seen = real(point) - RealPoint{view.apex.x, view.apex.y};
  if (std::abs(norm(seen) - got) > 1e-9L) return testing::AssertionFailure() << "the point is not at the distance";
  if (signedExcess(solid.outline, real(point)) > 1e-9L) {
    return testing::AssertionFailure() << "the point is not of the solid";
  }
  const RealPoint axis{std::cos(Real(view.axis_rad)), std::sin(Real(view.axis_rad))};
  const Real beyond = std::abs(angleBetween(axis, seen)) - view.half_width_rad;
  if (got > 0 && beyond * got > 1e-9L) return testing::AssertionFailure() << "the point is not in the sector";
  return testing::AssertionSuccess();
}

TEST(Sector, ContainsTheDirectionsBetweenItsEdges) {
  const Sector sector = Sector::towards({1, 2, 3}, M_PI / 2, k10Deg);
  EXPECT_TRUE(sector.contains({0, 1}));
  EXPECT_TRUE(sector.contains({0.17, 1})) << "9.65° aside";
  EXPECT_TRUE(sector.contains({-17, 100})) << "of any length";
  EXPECT_FALSE(sector.contains({0.18, 1})) << "10.2° aside";
  EXPECT_FALSE(sector.contains({0, -1})) << "straight behind";
  EXPECT_FALSE(sector.contains({-0.17, -1}));
  EXPECT_TRUE(sector.contains(sector.left));
  EXPECT_TRUE(sector.contains(sector.right));
  EXPECT_NEAR(sector.axis.y, 1, 1e-15);
  EXPECT_NEAR(sector.left.x, -std::sin(k10Deg), 1e-15);
  EXPECT_NEAR(sector.left.y, std::cos(k10Deg), 1e-15);
  EXPECT_NEAR(sector.right.x, std::sin(k10Deg), 1e-15);
}

TEST(Sector, FindsTheNearestPointOfWhatLiesAhead) {
  expectHit(ahead(k10Deg), highDisc(5, 0, 1), 4, {4, 0});
  expectHit(ahead(k10Deg), highBox(5, 0, 2, 2), 4, {4, 0});
  expectHit(ahead(k45Deg), highDisc(4, 3, 1), 4, {3.2, 2.4});
  // A box rotated by 45°: its nearest corner is √2/2 before its centre.
  expectHit(ahead(k10Deg), highBox(5, 0, 1, 1, k45Deg), 5 - std::sqrt(0.5), {5 - std::sqrt(0.5), 0});
  // The corner (3, 4) lies 53.13° to the left: within 60°, and nearer than any other point of the box.
  expectHit(ahead(M_PI / 3), highBox(5, 5, 4, 2), 5, {3, 4});
}

TEST(Sector, FindsThePointOnItsEdgeWhenTheNearestPointLiesOutside) {
  // The wall y = 3 within 45° of x: the nearest point, (0, 3), is outside; the edge y = x hits it at (3, 3).
  expectHit(ahead(k45Deg), highBox(0, 4, 100, 2), std::sqrt(18), {3, 3});
  expectHit(ahead(k45Deg), highBox(0, -4, 100, 2), std::sqrt(18), {3, -3});
  // A disc about (0, 5) with radius 4: the edge y = x hits it where x² + (x - 5)² = 16, so x = (5 - √7) / 2.
  const double x = (5 - std::sqrt(7)) / 2;
  expectHit(ahead(k45Deg), highDisc(0, 5, 4), x * std::sqrt(2), {x, x});
  expectHit(ahead(k45Deg), highDisc(0, -5, 4), x * std::sqrt(2), {x, -x});
}

TEST(Sector, IsInvariantUnderRotation) {
  for (double turn : {0.3, 1.7, M_PI, -M_PI, -2.5, 3 * M_PI, -7.0}) {
    const TPoint2D at{std::cos(turn) * 5, std::sin(turn) * 5};
    EXPECT_NEAR(nearestIn({{0, 0, 1}, turn, k10Deg}, highDisc(at.x, at.y, 1)).distance_m, 4, 1e-13) << turn;
    EXPECT_FALSE(nearestIn({{0, 0, 1}, turn + 0.6, k10Deg}, highDisc(at.x, at.y, 1))) << turn;
    EXPECT_FALSE(nearestIn({{0, 0, 1}, turn + M_PI, k10Deg}, highDisc(at.x, at.y, 1))) << turn;
  }
}

TEST(Sector, FindsNothingBehindOrAside) {
  EXPECT_FALSE(nearestIn(ahead(k45Deg), highDisc(-5, 0, 1)));
  EXPECT_FALSE(nearestIn(ahead(k45Deg), highBox(-5, 0, 2, 20)));
  EXPECT_FALSE(nearestIn(ahead(k45Deg), highBox(-5, -5, 2, 20))) << "behind, across both sides' lines";
  EXPECT_FALSE(nearestIn(ahead(k10Deg), highDisc(3, 3, 1)));
  EXPECT_FALSE(nearestIn(ahead(k10Deg), highBox(1, 5, 2, 6)));
  // tan 10° · 5 = 0.8816: a disc of radius 1 about (5, 2.0) reaches below that line, about (5, 1.9) too; its distance
  // from the line is (y - 0.8816) · cos 10°, equal to 1 at y = 1.8970.
  const double y = 5 * std::tan(k10Deg) + 1 / std::cos(k10Deg);
  EXPECT_TRUE(nearestIn(ahead(k10Deg), highDisc(5, y - 1e-9, 1)));
  EXPECT_FALSE(nearestIn(ahead(k10Deg), highDisc(5, y + 1e-9, 1)));
}

TEST(Sector, FindsABoxWithoutACornerInside) {
  expectHit(ahead(k10Deg), highBox(5, 0, 1, 100), 4.5, {4.5, 0});
  // A wall along (-1, 1) through (3, 0), 0.1 m thick: its near face is x + y = 3 - 0.1·√½. The foot of the
  // perpendicular lies at 45°, outside; the edge at 10° hits the face where r (cos 10° + sin 10°) = x + y.
  const double c = 3 - 0.1 * std::sqrt(0.5), r = c / (std::cos(k10Deg) + std::sin(k10Deg));
  expectHit(ahead(k10Deg), highBox(3, 0, 0.1, 100, k45Deg), r, {r * std::cos(k10Deg), r * std::sin(k10Deg)});
}

TEST(Sector, IsAtZeroWithinASolidAndOnItsOutline) {
  expectHit(ahead(k10Deg), highDisc(0.5, 0.5, 1), 0, {0, 0});
  expectHit(ahead(k10Deg), highBox(-0.5, 0, 2, 2), 0, {0, 0});
  expectHit(ahead(k10Deg), highDisc(1, 0, 1), 0, {0, 0});
  expectHit(ahead(k10Deg), highBox(1, 1, 2, 2), 0, {0, 0});
  expectHit(ahead(k10Deg), highBox(-1, 0, 2, 2), 0, {0, 0});
}

TEST(Sector, ConsidersItsHeight) {
  EXPECT_TRUE(nearestIn(ahead(k10Deg, 0), highDisc(5, 0, 1)));
  EXPECT_TRUE(nearestIn(ahead(k10Deg, 2), highDisc(5, 0, 1)));
  EXPECT_FALSE(nearestIn(ahead(k10Deg, 2.001), highDisc(5, 0, 1)));
  EXPECT_FALSE(nearestIn(ahead(k10Deg, -0.001), highBox(5, 0, 1, 1)));
  EXPECT_FALSE(nearestIn(ahead(k10Deg, 2.001), highBox(0, 0, 1, 1))) << "above a solid is not inside it";
}

TEST(Sector, AgreesWithClippingAndBisectionOverRandomSolids) {
  Rng rng(1);
  const SolidSpread families[] = {{.area = {-5, 5, -5, 5}},
                                  {.area = {-5, 5, -5, 5}, .lattice_m = 0.25},
                                  {.size_min_m = 0.001, .size_max_m = 100},
                                  {.area = {-5, 5, -5, 5}, .size_min_m = 0.001, .size_max_m = 0.1}};
  int grazes = 0, hits = 0;
  for (int i = 0; i < 60000; ++i) {
    const Solid solid = randomSolid(rng, families[i % 4]);
    const TPoint2D apex = randomPoint(rng, {-6, 6, -6, 6});
    const double half_width = i % 3 == 0 ? k10Deg : i % 3 == 1 ? rng.uniform(1e-3, 0.3) : rng.uniform(0.3, 1.57);
    View view{{apex.x, apex.y, rng.uniform(-0.1, 2.1)}, rng.uniform(-4, 4), half_width};
    if (i % 2) {
      // Half of them face the solid or slightly past it, at its height.
      const TPoint2D p = randomPoint(rng, boundsOf(solid.outline));
      view.apex.z = rng.uniform(solid.heights.z_min_m, solid.heights.z_max_m);
      view.axis_rad = std::atan2(p.y - apex.y, p.x - apex.x) + rng.uniform(-1.5, 1.5) * half_width;
    }
    ASSERT_TRUE(isExact(view, solid, grazes)) << "case " << i;
    hits += nearestIn(view, solid) ? 1 : 0;
  }
  EXPECT_GT(hits, 20000);
  EXPECT_LT(grazes, 10) << "grazing is rare";
}

TEST(Sector, AgreesWithClippingAndBisectionWhereItsSideMeetsACornerOrTangent) {
  Rng rng(2);
  int grazes = 0;
  for (int i = 0; i < 20000; ++i) {
    const Solid solid = randomSolid(rng, {.area = {-4, 4, -4, 4}, .lattice_m = i % 2 ? 0.25 : 0});
    const TPoint2D apex = randomPoint(rng, {-8, 8, -8, 8});
    const double half_width = rng.uniform(0.01, 1.5), side = rng.below(2) ? 1 : -1;
    double towards;
    if (const auto* circle = std::get_if<Circle>(&solid.outline)) {
      const TPoint2D to = circle->center - apex;
      const double aside = std::asin(std::min(1.0, circle->radius_m / std::hypot(to.x, to.y)));
      towards = std::atan2(to.y, to.x) + (rng.below(2) ? aside : -aside);
    } else {
      const RealPoint corner = cornersOf(std::get<OrientedBox>(solid.outline))[rng.below(4)];
      towards = std::atan2(double(corner.y) - apex.y, double(corner.x) - apex.x);
    }
    const View view{{apex.x, apex.y, solid.heights.z_max_m}, towards + side * half_width, half_width};
    ASSERT_TRUE(isExact(view, solid, grazes)) << "case " << i;
  }
}

TEST(Sector, IsNoFartherThanAnyRayWithinIt) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const Solid solid = randomSolid(rng, {.area = {-5, 5, -5, 5}, .z_min_m = 0.9, .z_max_m = 1.1});
    const View view{{0, 0, solid.heights.z_min_m}, rng.uniform(-M_PI, M_PI), rng.uniform(0.1, 1)};
    const Hit hit = nearestIn(view, solid);
    // Just within the edges: points on an edge may be rounded out of the sector.
    for (int k = 0; k <= 50; ++k) {
      const double turn = view.axis_rad + (k - 25) / 25.0 * (view.half_width_rad - 1e-9);
      const auto along = intersect(Ray::towards(view.apex, turn), solid);
      ASSERT_TRUE(!along || (hit && hit.distance_m <= *along + 1e-12)) << "case " << i << ", ray " << k;
    }
  }
}

}  // namespace
}  // namespace robosim
