#include "geometry/shapes/path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/angle_units.h"
#include "base/portable_math.h"
#include "base/wrapped_angle.h"
#include "geometry/shapes/chord_batch.h"
#include "geometry/shapes/planar_vector.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kTurnPerChord_rad = 3 * kRadPerDeg;
constexpr double kTurnPerChordStopping_rad = 0.1 * kRadPerDeg;  // of Path::turn_stops
/// A slide along a wall may appear as an approach of up to this much [m] per step because of rounding; it is not
/// treated as one. A million such steps would use up the contact gap. Positions are relative to the disc's start, so
/// the bound holds anywhere in the world.
constexpr double kSlideTolerance_m = 1e-12;

/// Displacement of the centre from the start after a share of the whole arc, world axes.
TPoint2D onArc(const Path& path, double share) {
  if (share == 0) return {};
  const double half_turn = share * path.turn_rad / 2;
  const double sinc = half_turn == 0 ? 1 : portable::sin(half_turn) / half_turn;
  const double chord = share * path.length_m * sinc;
  const auto [sin, cos] = portable::sincos(path.world_from_start.phi + path.direction_rad + half_turn);
  return {chord * cos, chord * sin};
}

/// Displacement of the centre from the start at a fraction of the step; constant beyond end_fraction.
TPoint2D displacementAt(const Path& path, double fraction) {
  const double at = std::min(fraction, path.end_fraction);
  if (at == 1) return onArc(path, 1);
  const int n = path.chords();
  const double in_chords = at * n;
  const double chord = std::min(std::floor(in_chords), n - 1.0);
  const double rest = in_chords - chord;
  const TPoint2D from = onArc(path, chord / n);
  if (rest == 0) return from;
  const TPoint2D to = onArc(path, (chord + 1) / n);
  return from + (to - from) * rest;
}

TPoint2D startOf(const Path& path) { return {path.world_from_start.x, path.world_from_start.y}; }

/// Fraction of the displacement d at which a point that starts at p enters the disc about `center`. A point that starts
/// inside is stopped (0) if it approaches the centre. All coordinates are relative to the path's start.
std::optional<double> enterDisc(const TPoint2D& p, const TPoint2D& d, const TPoint2D& center, double radius) {
  const TPoint2D out = p - center;
  const double b = dot(out, d);
  const double c = dot(out, out) - radius * radius;
  const double a = dot(d, d);
  if (a == 0 || b >= 0) return std::nullopt;
  // On a tangent, rounding decides whether the move begins with an approach. The amount of the approach decides
  // instead.
  const double nearest = std::min(1.0, -b / a);
  if (nearest * (-2 * b - nearest * a) <= 2 * kSlideTolerance_m * out.norm()) return std::nullopt;
  if (c < 0) return 0;
  const double left = b * b - a * c;
  if (left < 0) return std::nullopt;
  const double t = c / (-b + std::sqrt(left));  // the smaller root, without the cancellation of -b - √
  return t <= 1 ? std::optional(t) : std::nullopt;
}

/// The same for an outline grown by `grow_m` on all sides: a disc of that radius touches the outline when its centre
/// enters the grown one.
std::optional<double> enterGrown(const TPoint2D& p, const TPoint2D& d, const Circle& circle, const TPoint2D& center,
                                 double grow_m) {
  return enterDisc(p, d, center, circle.radius_m + grow_m);
}

std::optional<double> enterGrown(const TPoint2D& p_world, const TPoint2D& d_world, const OrientedBox& box,
                                 const TPoint2D& center, double grow_m) {
  const auto turned = [&](const TPoint2D& v) {
    return TPoint2D(dot(v, box.axis), v.y * box.axis.x - v.x * box.axis.y);
  };
  const TPoint2D p = turned(p_world - center);
  const TPoint2D d = turned(d_world);
  const TPoint2D half(box.half_length_m, box.half_width_m);

  const TPoint2D nearest(std::clamp(p.x, -half.x, half.x), std::clamp(p.y, -half.y, half.y));
  const TPoint2D out = p - nearest;
  // A straight move that does not approach a convex outline at first never approaches it.
  const bool inside = out.x == 0 && out.y == 0;
  const bool approaches = dot(out, d) < -kSlideTolerance_m * out.norm();
  if (!inside && !approaches) return std::nullopt;
  if (dot(out, out) < grow_m * grow_m) return 0;
  // The grown box is a rectangle with rounded corners. The move first enters the full rectangle. If the entry lies
  // beyond both sides of the box itself, only the corner's disc counts, because the outline between two corners is
  // convex.
  double from = 0;
  double to = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double reach = half[axis] + grow_m;
    if (d[axis] == 0) {
      if (std::abs(p[axis]) > reach) return std::nullopt;
      continue;
    }
    const double a = (-reach - p[axis]) / d[axis];
    const double b = (reach - p[axis]) / d[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  if (from > to) return std::nullopt;
  const TPoint2D entry = p + d * from;
  if (std::abs(entry.x) > half.x && std::abs(entry.y) > half.y) {
    return enterDisc(p, d, {std::copysign(half.x, entry.x), std::copysign(half.y, entry.y)}, grow_m);
  }
  return from;
}

}  // namespace

int Path::chords() const {
  if (length_m == 0) return 1;
  const double per_chord_rad = turn_stops ? kTurnPerChordStopping_rad : kTurnPerChord_rad;
  return std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / per_chord_rad)));
}

TPoint2D Path::centerAt(double fraction) const { return startOf(*this) + displacementAt(*this, fraction); }

mrpt::math::TPose2D Path::endPose() const {
  const TPoint2D center = centerAt(1);
  return {center.x, center.y, wrappedAngle(world_from_start.phi + clippedTurn())};
}

void computeEndPoses(std::span<const Path* const> paths, std::span<mrpt::math::TPose2D* const> poses) {
  ChordBatch chords;
  for (const Path* path : paths) {
    chords.add(path->world_from_start.phi + path->direction_rad, path->turn_rad / 2);
  }
  chords.compute();
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Path& path = *paths[i];
    if (path.end_fraction < 1) {
      *poses[i] = path.endPose();
      continue;
    }
    const auto [per_arc, direction] = chords[i];
    const double chord_m = path.length_m * per_arc;
    *poses[i] = {path.world_from_start.x + chord_m * direction.cos, path.world_from_start.y + chord_m * direction.sin,
                 wrappedAngle(path.world_from_start.phi + path.clippedTurn())};
  }
}

double firstContact(const Path& path, double radius_m, const Outline& outline) {
  if (path.length_m == 0) return 1;
  const TPoint2D start = startOf(path);
  if (distance(outline, start) > radius_m + kContactGap_m + std::abs(path.length_m)) return 1;
  const int n = path.chords();
  TPoint2D from;
  for (int i = 0; i < n; ++i) {
    const TPoint2D to = onArc(path, (i + 1.0) / n);
    const auto entered = std::visit(
        [&](const auto& shape) {
          return enterGrown(from, to - from, shape, shape.center - start, radius_m + kContactGap_m);
        },
        outline);
    if (entered) {
      const double fraction = (i + *entered) / n;
      return fraction < path.end_fraction ? fraction : 1;
    }
    if ((i + 1.0) / n >= path.end_fraction) break;
    from = to;
  }
  return 1;
}

double firstExit(const Path& path, double radius_m, const Bounds2D& area) {
  const double margin_m = radius_m + kContactGap_m;
  const double reach_m = margin_m + std::abs(path.length_m);
  const auto& start = path.world_from_start;
  if (start.x - reach_m >= area.x_min && start.x + reach_m <= area.x_max && start.y - reach_m >= area.y_min &&
      start.y + reach_m <= area.y_max) {
    return 1;
  }
  const int n = path.chords();
  TPoint2D from;
  for (int i = 0; i < n && i < path.end_fraction * n; ++i) {
    const TPoint2D to = onArc(path, (i + 1.0) / n);
    const TPoint2D d = to - from;
    double share = 2;  // fraction of the chord; > 1 for none
    const auto keep = [&](double gap_m, double outwards_m) {
      if (outwards_m > std::max(gap_m, kSlideTolerance_m)) share = std::min(share, std::max(0.0, gap_m / outwards_m));
    };
    keep(area.x_max - start.x - margin_m - from.x, d.x);
    keep(start.x - area.x_min - margin_m + from.x, -d.x);
    keep(area.y_max - start.y - margin_m - from.y, d.y);
    keep(start.y - area.y_min - margin_m + from.y, -d.y);
    if (share <= 1) {
      const double fraction = (i + share) / n;
      return fraction < path.end_fraction ? fraction : 1;
    }
    from = to;
  }
  return 1;
}

bool collide(const Path& a, double radius_a_m, const Path& b, double radius_b_m) {
  const double reach = radius_a_m + radius_b_m + kContactGap_m;
  const double gap_x = a.world_from_start.x - b.world_from_start.x;
  const double gap_y = a.world_from_start.y - b.world_from_start.y;
  const double nearest_possible = reach + std::abs(a.clippedLength()) + std::abs(b.clippedLength());
  if (gap_x * gap_x + gap_y * gap_y > nearest_possible * nearest_possible) return false;
  // Between two consecutive chord ends of either path both centres move at constant velocity, so their relative motion
  // is straight.
  const int chords_a = a.chords();
  const int chords_b = b.chords();
  double from = 0;
  const TPoint2D gap(gap_x, gap_y);
  TPoint2D p = gap;
  for (int i = 0, j = 0; from < 1;) {
    double to = 1;
    const double next_a = (i + 1.0) / chords_a;
    const double next_b = (j + 1.0) / chords_b;
    for (const double other : {next_a, next_b, a.end_fraction, b.end_fraction}) {
      if (other > from) to = std::min(to, other);
    }
    const TPoint2D q = gap + (displacementAt(a, to) - displacementAt(b, to));
    if (enterDisc(p, q - p, {0, 0}, reach)) return true;
    if (next_a <= to) ++i;
    if (next_b <= to) ++j;
    from = to;
    p = q;
  }
  return false;
}

}  // namespace robosim
