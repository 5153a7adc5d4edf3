#include "environment/move_authorisation.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

constexpr std::size_t kPathChunk = 64;

mrpt::math::TPoint2D startOf(const Path& path) { return {path.world_from_start.x, path.world_from_start.y}; }

}  // namespace

MoveAuthorisation::MoveAuthorisation(std::vector<Mover> movers, const Bounds2D& surface)
    : movers_(std::move(movers)),
      surface_(surface),
      may_have_neighbours_(movers_.size(), 0),
      stays_(movers_.size(), 0) {
  for (const auto& mover : movers_) radius_max_m_ = std::max(radius_max_m_, mover.radius_m);
}

void MoveAuthorisation::begin(const ParallelExecutor& workers, const KnownRobots& known, std::span<const Path> paths) {
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
    if (paths[i].length_m != 0) clip(scene, i, paths);
  });
}

// All pairs are judged on the clipped paths of both before any path is shortened further, so the result is
// order-independent.
void MoveAuthorisation::judge(const Scene& scene, const ParallelExecutor& workers, RobotRange range,
                              std::span<const Path> paths) {
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

std::span<const std::uint32_t> MoveAuthorisation::robotsNear(const Scene& scene, std::size_t robot,
                                                             const Path& path) const {
  static thread_local std::vector<std::uint32_t> found;
  const double reach_m =
      movers_[robot].radius_m + std::abs(path.length_m) + radius_max_m_ + length_max_m_ + kContactGap_m;
  scene.findMoving(startOf(path), reach_m, movers_.size(), found);
  return found;
}

void MoveAuthorisation::clip(const Scene& scene, std::size_t robot, std::span<Path> paths) {
  Path& path = paths[robot];
  const Mover& mover = movers_[robot];
  path.end_fraction = firstExit(path, mover.radius_m, surface_);
  scene.clip(path, mover.radius_m, mover.heights, scene.movingBody(robot));

  for (const auto other : robotsNear(scene, robot, path)) {
    if (other == robot) continue;
    may_have_neighbours_[robot] = 1;
    if (!movers_[other].heights.overlaps(mover.heights)) continue;
    const Circle disc{startOf(paths[other]), movers_[other].radius_m};
    path.end_fraction = std::min(path.end_fraction, firstContact(path, mover.radius_m, disc));
  }
}

bool MoveAuthorisation::collidesWithAnother(const Scene& scene, std::size_t robot, std::span<const Path> paths) const {
  const Path& path = paths[robot];
  // Rule (a) has already clipped the path at robots that stand still, and a robot that stands still stays anyway.
  if (path.clippedLength() == 0 || !may_have_neighbours_[robot]) return false;
  const Mover& mover = movers_[robot];
  const auto near = robotsNear(scene, robot, path);
  return std::any_of(near.begin(), near.end(), [&](std::uint32_t other) {
    return other != robot && paths[other].clippedLength() != 0 && movers_[other].heights.overlaps(mover.heights) &&
           collide(path, mover.radius_m, paths[other], movers_[other].radius_m);
  });
}

}  // namespace robosim
