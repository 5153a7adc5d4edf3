#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/random.h"
#include "geometry/shapes/path.h"
#include "geometry/testing/random_scene.h"
#include "geometry/testing/slow_geometry.h"

namespace robosim {

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
