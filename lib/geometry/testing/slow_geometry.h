#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "geometry/solid.h"

/// Slow answers to check the fast ones by: in long double (64 bits of mantissa), and by other ways than the room's own.
/// All rest on two facts: how far a point stands out of a convex outline is a convex function of the point, and what is
/// convex in the plane is convex along any straight line. So a search for the lowest value and a bisection find
/// every first contact, with no formula for circles meeting lines.
namespace robosim {

using Real = long double;

/// Two shapes that differ by this much pass for the same: doubles of a few hundred metres are not much finer. Where an
/// answer jumps (a ray that just touches, or just misses), either side of the jump is right if a change of this size
/// could bring it about.
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

/// Counter-clockwise.
inline std::array<RealPoint, 4> cornersOf(const OrientedBox& box) {
  const RealPoint along = real(box.axis) * box.half_length_m;
  const RealPoint across = RealPoint{-real(box.axis).y, real(box.axis).x} * box.half_width_m;
  const RealPoint c = real(box.center);
  return {c + along + across, c - along + across, c - along - across, c + along - across};
}

/// > 0 outside, 0 on the outline, < 0 inside; convex. For a box it is the farthest that the point stands out beyond any
/// of the four sides, which before a corner is less than the distance.
inline Real standsOut(const Outline& outline, RealPoint p) {
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

/// To the filled outline.
inline Real slowDistance(const Outline& outline, RealPoint p) {
  if (std::holds_alternative<Circle>(outline)) return std::max(Real(0), standsOut(outline, p));
  if (standsOut(outline, p) <= 0) return 0;
  const auto corners = cornersOf(std::get<OrientedBox>(outline));
  Real nearest = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    nearest = std::min(nearest, slowDistanceToSegment(p, corners[i], corners[(i + 1) % 4]));
  }
  return nearest;
}

/// Where in [from, to] the convex function is least.
template <typename Convex>
Real leastOf(const Convex& f, Real from, Real to) {
  // Thirds: 110 rounds shrink the span by 4e-20.
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
  Real inside = leastOf(f, from, to);
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
