#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "geometry/shapes/solid.h"

/// Slow reference implementations in long double (64 bits of mantissa) that use other algorithms than the module. All
/// rest on two facts: the signed distance of a point to a convex outline is a convex function of the point, and a
/// convex function in the plane is convex along any straight line. So a ternary search for the minimum and a bisection
/// find every first contact, without formulas for circle–line intersection.
namespace robosim {

using Real = long double;

/// Tolerance [m] below which two shapes count as equal: close to the resolution of doubles at a few hundred metres.
/// Where a result is discontinuous (a ray that just touches, or just misses), both sides are accepted if a change of
/// this size could cause either.
constexpr Real kGrain_m = 1e-12L;

struct RealPoint {
  Real x = 0, y = 0;
};

inline RealPoint operator+(RealPoint a, RealPoint b) { return {a.x + b.x, a.y + b.y}; }
inline RealPoint operator-(RealPoint a, RealPoint b) { return {a.x - b.x, a.y - b.y}; }
inline RealPoint operator*(RealPoint a, Real s) { return {a.x * s, a.y * s}; }
inline Real dot(RealPoint a, RealPoint b) { return a.x * b.x + a.y * b.y; }
inline Real cross(RealPoint a, RealPoint b) { return a.x * b.y - a.y * b.x; }
inline Real norm(RealPoint a) { return std::sqrt(dot(a, a)); }
inline RealPoint real(const mrpt::math::TPoint2D& p) { return {p.x, p.y}; }

/// Corners of a box, counter-clockwise.
inline std::array<RealPoint, 4> cornersOf(const OrientedBox& box) {
  const RealPoint along = real(box.axis) * box.half_length_m;
  const RealPoint across = RealPoint{-real(box.axis).y, real(box.axis).x} * box.half_width_m;
  const RealPoint c = real(box.center);
  return {c + along + across, c - along + across, c - along - across, c + along - across};
}

/// Convex function that is > 0 outside, 0 on the outline and < 0 inside. For a box, the maximum signed distance to its
/// four sides, which is less than the distance near a corner.
inline Real signedExcess(const Outline& outline, RealPoint p) {
  if (const auto* circle = std::get_if<Circle>(&outline)) return norm(p - real(circle->center)) - circle->radius_m;
  const auto& box = std::get<OrientedBox>(outline);
  const RealPoint from_center = p - real(box.center);
  return std::max(std::abs(dot(from_center, real(box.axis))) - box.half_length_m,
                  std::abs(cross(real(box.axis), from_center)) - box.half_width_m);
}

inline Real slowDistanceToSegment(RealPoint p, RealPoint a, RealPoint b) {
  const Real t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), Real(0), Real(1));
  return norm(p - (a + (b - a) * t));
}

/// Distance to the filled outline.
inline Real slowDistance(const Outline& outline, RealPoint p) {
  if (std::holds_alternative<Circle>(outline)) return std::max(Real(0), signedExcess(outline, p));
  if (signedExcess(outline, p) <= 0) return 0;
  const auto corners = cornersOf(std::get<OrientedBox>(outline));
  Real nearest = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    nearest = std::min(nearest, slowDistanceToSegment(p, corners[i], corners[(i + 1) % 4]));
  }
  return nearest;
}

/// Minimum position of a convex function in [from, to] by ternary search.
template <typename Convex>
Real argmin(const Convex& f, Real from, Real to) {
  // 110 rounds shrink the interval by a factor of 4e-20.
  for (int round = 0; round < 110; ++round) {
    const Real a = from + (to - from) / 3, b = to - (to - from) / 3;
    if (f(a) <= f(b)) {
      to = b;
    } else {
      from = a;
    }
  }
  return (from + to) / 2;
}

/// The first t in [from, to] where the convex function is at most `level`.
template <typename Convex>
std::optional<Real> firstAtMost(const Convex& f, Real from, Real to, Real level) {
  if (f(from) <= level) return from;
  Real inside = argmin(f, from, to);
  if (f(to) < f(inside)) inside = to;
  if (f(inside) > level) return std::nullopt;
  Real outside = from;
  for (int round = 0; round < 80; ++round) {
    const Real middle = (outside + inside) / 2;
    (f(middle) <= level ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace robosim
