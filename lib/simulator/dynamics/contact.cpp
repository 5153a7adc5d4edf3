#include "dynamics/contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/shapes/planar_vector.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

Contact flipped(Contact contact) {
  contact.normal = contact.normal * -1.0;
  return contact;
}

Contact between(const Circle& a, const Circle& b) {
  const TPoint2D way = b.center - a.center;
  const double far_m = std::sqrt(dot(way, way));
  const TPoint2D normal = far_m > 0 ? way * (1 / far_m) : TPoint2D(1, 0);
  return {normal, {{{a.center + normal * a.radius_m, far_m - a.radius_m - b.radius_m}, {}}}, 1};
}

/// Contact of a box with a disc about a point that lies inside the box: at the nearest side.
Contact fromInside(const OrientedBox& box, const TPoint2D& in_box, double radius_m) {
  const double to_end_m = box.half_length_m - std::abs(in_box.x);
  const double to_side_m = box.half_width_m - std::abs(in_box.y);
  const bool at_end = to_end_m < to_side_m;
  const TPoint2D normal =
      at_end ? box.axis * std::copysign(1.0, in_box.x) : turnedLeft(box.axis) * std::copysign(1.0, in_box.y);
  const double deep_m = at_end ? to_end_m : to_side_m;
  const TPoint2D center = box.center + box.axis * in_box.x + turnedLeft(box.axis) * in_box.y;
  return {normal, {{{center + normal * deep_m, -deep_m - radius_m}, {}}}, 1};
}

Contact between(const OrientedBox& box, const Circle& disc) {
  const TPoint2D way = disc.center - box.center;
  const TPoint2D in_box(dot(way, box.axis), dot(way, turnedLeft(box.axis)));
  const TPoint2D nearest(std::clamp(in_box.x, -box.half_length_m, box.half_length_m),
                         std::clamp(in_box.y, -box.half_width_m, box.half_width_m));
  const TPoint2D out = in_box - nearest;
  const double far_m = std::sqrt(dot(out, out));
  if (!(far_m > 0)) return fromInside(box, in_box, disc.radius_m);
  const auto to_world = [&](const TPoint2D& v) { return box.axis * v.x + turnedLeft(box.axis) * v.y; };
  return {to_world(out * (1 / far_m)), {{{box.center + to_world(nearest), far_m - disc.radius_m}, {}}}, 1};
}

Contact between(const Circle& disc, const OrientedBox& box) { return flipped(between(box, disc)); }

double halfProjection(const OrientedBox& box, const TPoint2D& direction) {
  return box.half_length_m * std::abs(dot(box.axis, direction)) +
         box.half_width_m * std::abs(dot(turnedLeft(box.axis), direction));
}

/// A side of a box: its outward normal, and its distance from the centre.
struct Side {
  TPoint2D out;
  double from_center_m, half_m;
};

/// The side of a box that faces a direction most.
Side sideTowards(const OrientedBox& box, const TPoint2D& direction) {
  const double along = dot(box.axis, direction);
  const double aside = dot(turnedLeft(box.axis), direction);
  if (std::abs(along) >= std::abs(aside)) {
    return {box.axis * std::copysign(1.0, along), box.half_length_m, box.half_width_m};
  }
  return {turnedLeft(box.axis) * std::copysign(1.0, aside), box.half_width_m, box.half_length_m};
}

/// Contact of the side of a box that has the outward normal `normal` with another box, from the first to the second.
Contact atSide(const OrientedBox& box, const TPoint2D& normal, const OrientedBox& other) {
  const Side face = sideTowards(box, normal);
  const Side facing = sideTowards(other, normal * -1.0);
  const TPoint2D along = turnedLeft(face.out);
  const TPoint2D center = other.center + facing.out * facing.from_center_m;
  const TPoint2D half = turnedLeft(facing.out) * facing.half_m;
  TPoint2D ends[2] = {center - half, center + half};
  const auto place_of = [&](const TPoint2D& p) { return dot(p - box.center, along); };
  const auto gap_of = [&](const TPoint2D& p) { return dot(p - box.center, face.out) - face.from_center_m; };
  double places[2] = {place_of(ends[0]), place_of(ends[1])};
  if (places[0] > places[1]) {
    std::swap(places[0], places[1]);
    std::swap(ends[0], ends[1]);
  }
  if (places[1] <= -face.half_m || places[0] >= face.half_m) {
    // Two corners are nearest to each other: the lower one counts.
    const TPoint2D& corner = gap_of(ends[0]) <= gap_of(ends[1]) ? ends[0] : ends[1];
    return {face.out, {{{corner, gap_of(corner)}, {}}}, 1};
  }
  const TPoint2D way = ends[1] - ends[0];
  const double length_m = places[1] - places[0];
  const double from = std::max(0.0, (-face.half_m - places[0]) / length_m);
  const double to = std::min(1.0, (face.half_m - places[0]) / length_m);
  const TPoint2D first = ends[0] + way * from;
  const TPoint2D last = ends[0] + way * to;
  return {face.out, {{{first, gap_of(first)}, {last, gap_of(last)}}}, 2};
}

Contact between(const OrientedBox& a, const OrientedBox& b) {
  const TPoint2D way = b.center - a.center;
  const TPoint2D directions[] = {a.axis, turnedLeft(a.axis), b.axis, turnedLeft(b.axis)};
  double gaps_m[4];
  for (int i = 0; i < 4; ++i) {
    gaps_m[i] = std::abs(dot(way, directions[i])) - halfProjection(a, directions[i]) - halfProjection(b, directions[i]);
  }
  const auto widest = std::max_element(std::begin(gaps_m), std::end(gaps_m)) - std::begin(gaps_m);
  const TPoint2D normal = directions[widest] * std::copysign(1.0, dot(way, directions[widest]));
  return widest < 2 ? atSide(a, normal, b) : flipped(atSide(b, normal * -1.0, a));
}

}  // namespace

Contact contactOf(const Outline& a, const Outline& b) {
  return std::visit([](const auto& one, const auto& other) { return between(one, other); }, a, b);
}

}  // namespace robosim
