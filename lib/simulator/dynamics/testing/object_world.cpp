#include "dynamics/testing/object_world.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

std::array<TPoint2D, 4> cornersOf(const OrientedBox& box) {
  const TPoint2D along = box.axis * box.half_length_m;
  const TPoint2D aside = TPoint2D(-box.axis.y, box.axis.x) * box.half_width_m;
  return {box.center + along + aside, box.center - along + aside, box.center - along - aside,
          box.center + along - aside};
}

/// How far two intervals, from the projections of corners, overlap.
double overlapAlong(const TPoint2D& direction, const OrientedBox& a, const OrientedBox& b) {
  const auto interval = [&](const OrientedBox& box) {
    std::pair<double, double> found(INFINITY, -INFINITY);
    for (const auto& corner : cornersOf(box)) {
      const double at = corner.x * direction.x + corner.y * direction.y;
      found = {std::min(found.first, at), std::max(found.second, at)};
    }
    return found;
  };
  const auto [a_low, a_high] = interval(a);
  const auto [b_low, b_high] = interval(b);
  return std::min(a_high - b_low, b_high - a_low);
}

double depth(const OrientedBox& a, const OrientedBox& b) {
  double least = INFINITY;
  for (const auto* box : {&a, &b}) {
    least = std::min({least, overlapAlong(box->axis, a, b), overlapAlong({-box->axis.y, box->axis.x}, a, b)});
  }
  return std::max(0.0, least);
}
double depth(const Circle& a, const Circle& b) {
  return std::max(0.0, a.radius_m + b.radius_m - (a.center - b.center).norm());
}
double depth(const OrientedBox& a, const Circle& b) {
  return std::max(0.0, b.radius_m - distance(a, b.center));  // all of the radius where the centre is inside
}
double depth(const Circle& a, const OrientedBox& b) { return depth(b, a); }

double depthOf(const Solid& a, const Solid& b) {
  if (!a.heights.overlaps(b.heights)) return 0;
  return std::visit([](const auto& one, const auto& other) { return depth(one, other); }, a.outline, b.outline);
}

}  // namespace

Scene ObjectWorld::scene() const {
  Scene scene(walls, robots.size() + objects.size(), surface);
  for (std::size_t r = 0; r < robots.size(); ++r) {
    scene.place(r, {Circle{{poses[r].x, poses[r].y}, robots[r].radius_m}, robots[r].heights});
  }
  for (std::size_t k = 0; k < objects.size(); ++k) {
    scene.place(robots.size() + k, {outlineOf(k), bodies[k].heights});
  }
  scene.freeze();
  return scene;
}

void ObjectWorld::step(double period_s, int threads) {
  std::vector<Path> paths;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    const double turn_radps = r < turns_radps.size() ? turns_radps[r] : 0;
    paths.push_back({poses[r], speeds_mps[r] * period_s, turn_radps * period_s});
    for (const auto& wall : walls) {
      paths.back().end_fraction =
          std::min(paths.back().end_fraction, firstContact(paths.back(), robots[r].radius_m, wall.outline));
    }
    paths.back().end_fraction =
        std::min(paths.back().end_fraction, firstExit(paths.back(), robots[r].radius_m, surface));
  }
  ObjectMover mover(bodies, belts, robots, surface);
  mover.move(scene(), ParallelExecutor(threads), period_s, 1, {}, paths, objects);
  for (std::size_t r = 0; r < robots.size(); ++r) {
    poses[r] = paths[r].endPose();
    is_blocked[r] = paths[r].end_fraction < 1;
  }
}

void ObjectWorld::run(double duration_s, double period_s) {
  for (auto left = std::lround(duration_s / period_s); left > 0; --left) step(period_s);
}

double ObjectWorld::energy() const {
  double sum_j = 0;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const auto& motion = objects[k];
    const double turn_mps = motion.turn_radps * bodies[k].turn_radius_m;
    sum_j +=
        bodies[k].mass_kg / 2 * (motion.vx_mps * motion.vx_mps + motion.vy_mps * motion.vy_mps + turn_mps * turn_mps);
  }
  return sum_j;
}

double ObjectWorld::deepestOverlap() const {
  std::vector<Solid> all = walls;
  for (const auto& edge : ObjectMover::edgesOf(surface)) all.push_back({edge, {-10, 10}});
  const std::size_t fixed = all.size();
  for (std::size_t r = 0; r < robots.size(); ++r) {
    all.push_back({Circle{{poses[r].x, poses[r].y}, robots[r].radius_m}, robots[r].heights});
  }
  for (std::size_t k = 0; k < objects.size(); ++k) all.push_back({outlineOf(k), bodies[k].heights});
  double deepest_m = 0;
  for (std::size_t i = fixed; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) deepest_m = std::max(deepest_m, depthOf(all[i], all[j]));
  }
  return deepest_m;
}

}  // namespace robosim
