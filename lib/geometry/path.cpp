#include "geometry/path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <mrpt/math/wrap2pi.h>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kTurnPerChord_rad = 3 * M_PI / 180;
/// Rounding may make a slide along a wall look like an approach of this much [m] a step, a kilometre from the origin;
/// it is no approach. A million steps of nothing but such rounding would use up the contact gap.
constexpr double kSlideTolerance_m = 1e-12;

double dot(const TPoint2D& a, const TPoint2D& b) { return a.x * b.x + a.y * b.y; }

/// Where the centre would be after a share of the whole arc.
TPoint2D onArc(const Path& path, double share) {
  if (share == 0) return {path.world_from_start.x, path.world_from_start.y};
  const double half_turn = share * path.turn_rad / 2;
  const double sinc = half_turn == 0 ? 1 : std::sin(half_turn) / half_turn;
  const double chord = share * path.length_m * sinc;
  const double direction = path.world_from_start.phi + half_turn;
  return {path.world_from_start.x + chord * std::cos(direction), path.world_from_start.y + chord * std::sin(direction)};
}

/// For a point that moves from p by d: the fraction of d at which it enters the disc about `center`. A point that
/// starts inside is stopped (0) if it comes nearer to the centre.
std::optional<double> enterDisc(const TPoint2D& p, const TPoint2D& d, const TPoint2D& center, double radius) {
  const TPoint2D out = p - center;
  const double b = dot(out, d);
  const double c = dot(out, out) - radius * radius;
  if (c < 0) {
    return b < -kSlideTolerance_m * out.norm() ? std::optional(0.0) : std::nullopt;
  }
  const double a = dot(d, d);
  if (a == 0 || b >= 0) return std::nullopt;
  const double left = b * b - a * c;
  if (left < 0) return std::nullopt;
  const double t = c / (-b + std::sqrt(left));  // the smaller root, without the loss of digits of -b - √
  return t <= 1 ? std::optional(t) : std::nullopt;
}

/// The same for an outline grown by `grow_m` on all sides: what a disc of that radius meets is what its centre enters.
std::optional<double> enterGrown(const TPoint2D& p, const TPoint2D& d, const Circle& circle, double grow_m) {
  return enterDisc(p, d, circle.center, circle.radius_m + grow_m);
}

std::optional<double> enterGrown(const TPoint2D& p_world, const TPoint2D& d_world, const OrientedBox& box,
                                 double grow_m) {
  const auto turned = [&](const TPoint2D& v) {
    return TPoint2D(dot(v, box.axis), v.y * box.axis.x - v.x * box.axis.y);
  };
  const TPoint2D p = turned(p_world - box.center);
  const TPoint2D d = turned(d_world);
  const TPoint2D half(box.half_length_m, box.half_width_m);

  const TPoint2D nearest(std::clamp(p.x, -half.x, half.x), std::clamp(p.y, -half.y, half.y));
  const TPoint2D out = p - nearest;
  // The distance to a convex outline only grows along a straight move that does not approach it at first.
  const bool inside = out.x == 0 && out.y == 0;
  const bool approaches = dot(out, d) < -kSlideTolerance_m * out.norm();
  if (!inside && !approaches) return std::nullopt;
  if (dot(out, out) < grow_m * grow_m) return 0;
  // The grown box is a rectangle with rounded corners. Enter the full rectangle first; where that happens beyond both
  // sides of the box itself, only the corner's disc counts, for the outline between two corners is convex.
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
  return std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / kTurnPerChord_rad)));
}

TPoint2D Path::centerAt(double fraction) const {
  const double at = std::min(fraction, end_fraction);
  if (at == 1) return onArc(*this, 1);
  const int n = chords();
  const double in_chords = at * n;
  const double chord = std::min(std::floor(in_chords), n - 1.0);
  const double rest = in_chords - chord;
  const TPoint2D from = onArc(*this, chord / n);
  if (rest == 0) return from;
  const TPoint2D to = onArc(*this, (chord + 1) / n);
  return from + (to - from) * rest;
}

mrpt::math::TPose2D Path::endPose() const {
  const TPoint2D center = centerAt(1);
  return {center.x, center.y, mrpt::math::wrapToPi(world_from_start.phi + turn_rad)};
}

double firstContact(const Path& path, double radius_m, const Outline& outline) {
  if (path.length_m == 0) return 1;
  const TPoint2D start(path.world_from_start.x, path.world_from_start.y);
  if (distance(outline, start) > radius_m + kContactGap_m + std::abs(path.length_m)) return 1;
  const int n = path.chords();
  TPoint2D from = onArc(path, 0);
  for (int i = 0; i < n; ++i) {
    const TPoint2D to = onArc(path, (i + 1.0) / n);
    const auto entered = std::visit(
        [&](const auto& shape) { return enterGrown(from, to - from, shape, radius_m + kContactGap_m); }, outline);
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
  TPoint2D from = onArc(path, 0);
  for (int i = 0; i < n && i < path.end_fraction * n; ++i) {
    const TPoint2D to = onArc(path, (i + 1.0) / n);
    const TPoint2D d = to - from;
    double share = 2;  // of the chord; beyond 1 for none
    const auto keep = [&](double room_m, double outwards_m) {
      if (outwards_m > std::max(room_m, kSlideTolerance_m)) share = std::min(share, std::max(0.0, room_m / outwards_m));
    };
    keep(area.x_max - margin_m - from.x, d.x);
    keep(from.x - area.x_min - margin_m, -d.x);
    keep(area.y_max - margin_m - from.y, d.y);
    keep(from.y - area.y_min - margin_m, -d.y);
    if (share <= 1) {
      const double fraction = (i + share) / n;
      return fraction < path.end_fraction ? fraction : 1;
    }
    from = to;
  }
  return 1;
}

bool meet(const Path& a, double radius_a_m, const Path& b, double radius_b_m) {
  const double reach = radius_a_m + radius_b_m + kContactGap_m;
  const double gap_x = a.world_from_start.x - b.world_from_start.x;
  const double gap_y = a.world_from_start.y - b.world_from_start.y;
  const double nearest_possible = reach + std::abs(a.clippedLength()) + std::abs(b.clippedLength());
  if (gap_x * gap_x + gap_y * gap_y > nearest_possible * nearest_possible) return false;
  // Between two neighbouring breaks of either way both centres move evenly, so one seen from the other moves straight.
  const int chords_a = a.chords();
  const int chords_b = b.chords();
  double from = 0;
  TPoint2D p = a.centerAt(0) - b.centerAt(0);
  for (int i = 0, j = 0; from < 1;) {
    double to = 1;
    const double next_a = (i + 1.0) / chords_a;
    const double next_b = (j + 1.0) / chords_b;
    for (const double other : {next_a, next_b, a.end_fraction, b.end_fraction}) {
      if (other > from) to = std::min(to, other);
    }
    const TPoint2D q = a.centerAt(to) - b.centerAt(to);
    if (enterDisc(p, q - p, {0, 0}, reach)) return true;
    if (next_a <= to) ++i;
    if (next_b <= to) ++j;
    from = to;
    p = q;
  }
  return false;
}

}  // namespace robosim
