#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "base/random.h"
#include "geometry/shapes/path.h"
#include "geometry/testing/random_scene.h"

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

/// Random path of 5 cm to 10 m per step, forwards or backwards: straight, almost straight, slightly curved, or several
/// turns.
inline Path randomPath(Rng& rng, const Bounds2D& area) {
  const mrpt::math::TPoint2D from = randomPoint(rng, area);
  Path path{{from.x, from.y, rng.uniform(-M_PI, M_PI)}, std::pow(10, rng.uniform(-1.3, 1)), 0};
  if (rng.below(2)) path.length_m = -path.length_m;
  constexpr double kMaxTurn_rad[] = {0, 1e-7, 0.5, 7};
  const double max_turn_rad = kMaxTurn_rad[rng.below(4)];
  path.turn_rad = rng.uniform(-max_turn_rad, max_turn_rad);
  return path;
}

/// Position on the exact arc: its chord from the start has the length length · sin(turn / 2) / (turn / 2) and half the
/// turn as its angle.
inline RealPoint onArc(const Path& path, Real fraction) {
  const auto& start = path.world_from_start;
  const Real half = path.turn_rad * fraction / 2, length = path.length_m * fraction;
  const Real straight = half == 0 ? length : length * std::sin(half) / half;
  return RealPoint{start.x, start.y} + RealPoint{std::cos(start.phi + half), std::sin(start.phi + half)} * straight;
}

/// Position on the chain of chords, which stops at its end.
inline RealPoint onChords(const Path& path, Real fraction) {
  const int n = path.chords();
  const Real along = std::min(fraction, Real(path.end_fraction)) * n;
  const int chord = std::min(static_cast<int>(along), n - 1);
  const RealPoint a = onArc(path, Real(chord) / n), b = onArc(path, Real(chord + 1) / n);
  return a + (b - a) * (along - chord);
}

/// First contact, chord by chord, because the distance to an outline is convex along each chord. nullopt when the disc,
/// with its contact gap enlarged by `more_m`, never comes that near.
inline std::optional<Real> slowFirstContact(const Path& path, double radius_m, const Outline& outline, Real more_m) {
  const int n = path.chords();
  const Real near = Real(radius_m) + kContactGap_m + more_m;
  for (int chord = 0; chord < n; ++chord) {
    const Real from = Real(chord) / n, to = std::min(Real(chord + 1) / n, Real(path.end_fraction));
    if (from > to) break;
    const RealPoint a = onArc(path, from), b = onArc(path, Real(chord + 1) / n);
    const auto away = [&](Real f) { return slowDistance(outline, a + (b - a) * ((f - from) * n)); };
    if (away(from) > near + norm(b - a)) continue;
    if (const auto contact = firstAtMost(away, from, to, near)) return contact;
  }
  return std::nullopt;
}

/// Distance by which the disc with its contact gap extends beyond the area at a fraction; < 0 inside.
inline Real excessBeyond(const Bounds2D& area, const Path& path, double radius_m, Real fraction) {
  const RealPoint p = onChords(path, fraction);
  return std::max({p.x - area.x_max, area.x_min - p.x, p.y - area.y_max, area.y_min - p.y}) + radius_m + kContactGap_m;
}

/// First exit of a disc that starts inside: the excess is convex along a chord, so a chord that ends inside never left.
inline std::optional<Real> slowFirstExit(const Path& path, double radius_m, const Bounds2D& area) {
  const int n = path.chords();
  for (int chord = 0; chord < n; ++chord) {
    Real inside = Real(chord) / n, outside = std::min(Real(chord + 1) / n, Real(path.end_fraction));
    if (inside > outside) break;
    if (excessBeyond(area, path, radius_m, outside) <= 0) continue;
    for (int round = 0; round < 80; ++round) {
      const Real middle = (inside + outside) / 2;
      (excessBeyond(area, path, radius_m, middle) > 0 ? outside : inside) = middle;
    }
    return outside;
  }
  return std::nullopt;
}

/// Minimum distance of the two discs' centres in the step. Between consecutive chord ends of either path their relative
/// motion is straight and uniform, so their distance is convex.
inline Real slowNearest(const Path& a, const Path& b) {
  std::vector<Real> ends{0, 1};
  for (const Path* path : {&a, &b}) {
    for (int k = 1; k < path->chords(); ++k) ends.push_back(Real(k) / path->chords());
    ends.push_back(path->end_fraction);
  }
  std::sort(ends.begin(), ends.end());
  std::vector<RealPoint> of_a, of_b;
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const Real end : ends) {
    of_a.push_back(onChords(a, end));
    of_b.push_back(onChords(b, end));
    nearest = std::min(nearest, norm(of_a.back() - of_b.back()));
  }
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const RealPoint apart = of_a[i] - of_b[i], change = (of_a[i + 1] - of_b[i + 1]) - apart;
    if (norm(apart) - norm(change) > nearest) continue;
    const auto distance = [&](Real part) { return norm(apart + change * part); };
    nearest = std::min(nearest, distance(argmin(distance, 0, 1)));
  }
  return nearest;
}

}  // namespace robosim
