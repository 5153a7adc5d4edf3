#include "environment/move_authorisation.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

constexpr std::size_t kPathChunk = 64;

mrpt::math::TPoint2D startOf(const Path& path) { return {path.world_from_start.x, path.world_from_start.y}; }

Mover moverOf(const HeldObject& held) { return {held.radius_m, held.heights}; }

/// Clips the path of a disc at one that stands.
void clipAt(const Mover& standing, const mrpt::math::TPoint2D& center, const Mover& disc, Path& path) {
  if (!standing.heights.overlaps(disc.heights)) return;
  path.end_fraction = std::min(path.end_fraction, firstContact(path, disc.radius_m, Circle{center, standing.radius_m}));
}

/// Whether nothing of a robot moves that could meet another.
bool isStill(const Path& path) { return path.clippedLength() == 0 && (!path.turn_stops || path.clippedTurn() == 0); }

}  // namespace

MoveAuthorisation::MoveAuthorisation(const std::vector<Mover>& movers, const Bounds2D& surface)
    : movers_(movers), surface_(surface), may_have_neighbours_(movers_.size(), 0), stays_(movers_.size(), 0) {
  for (const auto& mover : movers_.values()) radius_max_m_ = std::max(radius_max_m_, mover.radius_m);
}

void MoveAuthorisation::begin(const ParallelExecutor& workers, const KnownRobots& known, std::span<const Path> paths,
                              std::span<const HeldObject> held) {
  if (!held_.empty() || !held.empty()) held_.assign(held.begin(), held.end());
  if (movers_.size() == 1) return;  // the rest is about other robots; stays_ remains 0
  extent_max_m_ = radius_max_m_;
  for (const auto& object : held_) extent_max_m_ = std::max(extent_max_m_, object.extent());
  length_max_m_ = known.inOrder([&](const auto& order) {
    const auto longest_of = [&](std::size_t begin, std::size_t end) {
      double longest_m = 0;
      for (std::size_t k = begin; k < end; ++k) longest_m = std::max(longest_m, std::abs(paths[order[k]].length_m));
      return longest_m;
    };
    return workers.reduce(order.size(), 0.0, longest_of, [](double a, double b) { return std::max(a, b); });
  });
  // Conservative for the robots that another process clips; judge() then checks.
  std::fill(may_have_neighbours_.begin(), may_have_neighbours_.end(), 1);
  std::fill(stays_.begin(), stays_.end(), 0);
}

void MoveAuthorisation::clip(const Scene& scene, const ParallelExecutor& workers, RobotRange range,
                             std::span<Path> paths) {
  workers.forEach(range.end - range.begin, kPathChunk, [&](std::size_t k) {
    const std::size_t i = range.begin + k;
    may_have_neighbours_[i] = 0;
    if (paths[i].length_m != 0) clip(scene, i, movers_[i], scene.movingBody(i), paths, paths[i]);
  });
  workers.forEach(held_.size(), 1, [&](std::size_t h) {
    if (range.contains(held_[h].robot)) clipHeld(scene, held_[h], paths);
  });
}

// All pairs are judged on the clipped paths of both before any path is shortened further, so the result is
// order-independent.
void MoveAuthorisation::judge(const Scene& scene, const ParallelExecutor& workers, RobotRange range,
                              std::span<const Path> paths) {
  if (movers_.size() == 1) return;  // nothing makes it stay
  workers.forEach(range.end - range.begin, kPathChunk, [&](std::size_t k) {
    const std::size_t i = range.begin + k;
    stays_[i] = collidesWithAnother(scene, i, paths) ? 1 : 0;
  });
}

void MoveAuthorisation::conclude(const ParallelExecutor& workers, const KnownRobots& known, std::span<Path> paths,
                                 std::span<std::uint8_t> stalled) {
  known.forEach(workers, kPathChunk, [&](std::size_t i) {
    if (stays_[i]) paths[i].end_fraction = 0;
    stalled[i] = paths[i].end_fraction < 1 ? 1 : 0;
  });
}

double MoveAuthorisation::extentOf(std::size_t robot) const {
  const HeldObject* const held = heldBy(held_, robot);
  return held ? std::max(movers_[robot].radius_m, held->extent()) : movers_[robot].radius_m;
}

std::span<const std::uint32_t> MoveAuthorisation::robotsNear(const Scene& scene, std::size_t robot,
                                                             const Path& path) const {
  if (movers_.size() == 1) return {};
  static thread_local std::vector<std::uint32_t> found;
  const double own_m = held_.empty() ? movers_[robot].radius_m : extentOf(robot);
  const double reach_m = own_m + std::abs(path.length_m) + extent_max_m_ + length_max_m_ + kContactGap_m;
  scene.findMoving(startOf(path), reach_m, movers_.size(), found);
  return found;
}

void MoveAuthorisation::clipHeld(const Scene& scene, const HeldObject& held, std::span<Path> paths) {
  Path way = held.pathOf(paths[held.robot]);
  if (way.length_m == 0) return;
  clip(scene, held.robot, moverOf(held), kNoBody, paths, way);
  paths[held.robot].end_fraction = std::min(paths[held.robot].end_fraction, way.end_fraction);
}

void MoveAuthorisation::clip(const Scene& scene, std::size_t robot, const Mover& disc, BodyId owner,
                             std::span<const Path> paths, Path& path) {
  path.end_fraction = firstExit(path, disc.radius_m, surface_);
  scene.clip(path, disc.radius_m, disc.heights, owner);

  for (const auto other : robotsNear(scene, robot, paths[robot])) {
    if (other == robot) continue;
    may_have_neighbours_[robot] = 1;
    clipAt(movers_[other], startOf(paths[other]), disc, path);
    if (held_.empty()) continue;
    if (const HeldObject* const held = heldBy(held_, other)) {
      const auto pose = held->poseAt(paths[other].world_from_start);
      clipAt(moverOf(*held), {pose.x, pose.y}, disc, path);
    }
  }
}

bool MoveAuthorisation::collidesWithAnother(const Scene& scene, std::size_t robot, std::span<const Path> paths) const {
  const Path& path = paths[robot];
  // Rule (a) has already clipped the path at robots that stand still, and a robot that stands still stays anyway.
  if (isStill(path) || !may_have_neighbours_[robot]) return false;
  const auto near = robotsNear(scene, robot, path);
  return std::any_of(near.begin(), near.end(), [&](std::uint32_t other) {
    return other != robot && !isStill(paths[other]) && collide(robot, other, paths);
  });
}

bool MoveAuthorisation::collide(std::size_t robot, std::size_t other, std::span<const Path> paths) const {
  const auto meet = [](const Path& a, const Mover& of_a, const Path& b, const Mover& of_b) {
    return of_a.heights.overlaps(of_b.heights) && robosim::collide(a, of_a.radius_m, b, of_b.radius_m);
  };
  if (meet(paths[robot], movers_[robot], paths[other], movers_[other])) return true;
  if (held_.empty()) return false;
  const HeldObject* const own = heldBy(held_, robot);
  const HeldObject* const others = heldBy(held_, other);
  if (own && meet(own->pathOf(paths[robot]), moverOf(*own), paths[other], movers_[other])) return true;
  if (!others) return false;
  const Path others_path = others->pathOf(paths[other]);
  return meet(paths[robot], movers_[robot], others_path, moverOf(*others)) ||
         (own && meet(own->pathOf(paths[robot]), moverOf(*own), others_path, moverOf(*others)));
}

}  // namespace robosim
