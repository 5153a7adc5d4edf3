#include "environment/authorise.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

constexpr std::size_t kChunk = 64;

Bounds2D around(const mrpt::math::TPose2D& center, double reach_m) {
  return {center.x - reach_m, center.x + reach_m, center.y - reach_m, center.y + reach_m};
}

/// Bodies found near a robot; kept so that looking allocates only until it has grown.
std::vector<BodyId>& emptyList() {
  static thread_local std::vector<BodyId> bodies;
  bodies.clear();
  return bodies;
}

}  // namespace

Authority::Authority(std::vector<Mover> movers, const Bounds2D& surface)
    : movers_(std::move(movers)), surface_(surface), has_company_(movers_.size(), 0), stays_(movers_.size(), 0) {
  for (const auto& mover : movers_) radius_max_m_ = std::max(radius_max_m_, mover.radius_m);
}

void Authority::begin(std::span<const Path> paths) {
  length_max_m_ = 0;
  for (const auto& path : paths) length_max_m_ = std::max(length_max_m_, std::abs(path.length_m));
}

void Authority::clip(const Scene& scene, const Workers& workers, RobotRange range, std::span<Path> paths) {
  workers.forEach(range.end - range.begin, kChunk, [&](std::size_t k) {
    const std::size_t i = range.begin + k;
    has_company_[i] = 0;
    if (paths[i].length_m != 0) clip(scene, i, paths);
  });
}

void Authority::putClipped(std::size_t robot, double end_fraction, std::span<Path> paths) {
  paths[robot].end_fraction = end_fraction;
  has_company_[robot] = 1;  // perhaps it has none; then judge() finds out
}

// All pairs are judged on the clipped paths of both before any is shortened further: no order decides.
void Authority::judge(const Scene& scene, const Workers& workers, RobotRange range, std::span<const Path> paths) {
  workers.forEach(range.end - range.begin, kChunk, [&](std::size_t k) {
    const std::size_t i = range.begin + k;
    stays_[i] = meetsAnother(scene, i, paths) ? 1 : 0;
  });
}

void Authority::conclude(const Workers& workers, std::span<Path> paths, std::span<std::uint8_t> stalled) {
  workers.forEach(paths.size(), kChunk, [&](std::size_t i) {
    if (stays_[i]) paths[i].end_fraction = 0;
    stalled[i] = paths[i].end_fraction < 1 ? 1 : 0;
  });
}

double Authority::reachOfMeeting(std::size_t robot, const Path& path) const {
  return movers_[robot].radius_m + std::abs(path.length_m) + radius_max_m_ + length_max_m_ + kContactGap_m;
}

void Authority::clip(const Scene& scene, std::size_t robot, std::span<Path> paths) {
  Path& path = paths[robot];
  const Mover& mover = movers_[robot];
  const double reach_m = mover.radius_m + std::abs(path.length_m) + kContactGap_m;

  path.end_fraction = firstExit(path, mover.radius_m, surface_);
  auto& bodies = emptyList();
  scene.stationaryNear(around(path.world_from_start, reach_m), bodies);
  for (const BodyId body : bodies) {
    const Solid& solid = scene.solid(body);
    if (!solid.heights.overlaps(mover.heights)) continue;
    path.end_fraction = std::min(path.end_fraction, firstContact(path, mover.radius_m, solid.outline));
  }

  bodies.clear();
  scene.movingNear(around(path.world_from_start, reachOfMeeting(robot, path)), bodies);
  has_company_[robot] = bodies.size() > 1 ? 1 : 0;  // the robot itself is always found
  for (const BodyId body : bodies) {
    const std::size_t other = scene.movingIndex(body);
    if (other == robot || !movers_[other].heights.overlaps(mover.heights)) continue;
    const auto& start = paths[other].world_from_start;
    const Circle disc{{start.x, start.y}, movers_[other].radius_m};
    path.end_fraction = std::min(path.end_fraction, firstContact(path, mover.radius_m, disc));
  }
}

bool Authority::meetsAnother(const Scene& scene, std::size_t robot, std::span<const Path> paths) const {
  const Path& path = paths[robot];
  // Against those that stand still, (a) has clipped the path already; and a stay would be no news to one of these.
  if (path.clippedLength() == 0 || !has_company_[robot]) return false;
  const Mover& mover = movers_[robot];
  auto& bodies = emptyList();
  scene.movingNear(around(path.world_from_start, reachOfMeeting(robot, path)), bodies);
  return std::any_of(bodies.begin(), bodies.end(), [&](BodyId body) {
    const std::size_t other = scene.movingIndex(body);
    return other != robot && paths[other].clippedLength() != 0 && movers_[other].heights.overlaps(mover.heights) &&
           meet(path, mover.radius_m, paths[other], movers_[other].radius_m);
  });
}

}  // namespace robosim
