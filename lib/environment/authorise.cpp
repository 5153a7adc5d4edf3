#include "environment/authorise.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

constexpr std::size_t kChunk = 64;

mrpt::math::TPoint2D startOf(const Path& path) { return {path.world_from_start.x, path.world_from_start.y}; }

}  // namespace

Authority::Authority(std::vector<Mover> movers, const Bounds2D& surface)
    : movers_(std::move(movers)), surface_(surface), has_company_(movers_.size(), 0), stays_(movers_.size(), 0) {
  for (const auto& mover : movers_) radius_max_m_ = std::max(radius_max_m_, mover.radius_m);
}

void Authority::begin(std::span<const Path> paths) {
  length_max_m_ = 0;
  for (const auto& path : paths) length_max_m_ = std::max(length_max_m_, std::abs(path.length_m));
}

void Authority::clip(const Scene& scene, std::span<const NeighbourList> near, const Workers& workers, RobotRange range,
                     std::span<Path> paths) {
  workers.forEach(range.end - range.begin, kChunk, [&](std::size_t k) {
    const std::size_t i = range.begin + k;
    has_company_[i] = 0;
    if (paths[i].length_m != 0) clip(scene, near[i], i, paths);
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

void Authority::clip(const Scene& scene, const NeighbourList& near, std::size_t robot, std::span<Path> paths) {
  Path& path = paths[robot];
  const Mover& mover = movers_[robot];
  const double reach_m = mover.radius_m + std::abs(path.length_m) + kContactGap_m;

  path.end_fraction = firstExit(path, mover.radius_m, surface_);
  scene.visitStationary(startOf(path), reach_m, near, [&](const Solid& solid) {
    if (!solid.heights.overlaps(mover.heights)) return;
    path.end_fraction = std::min(path.end_fraction, firstContact(path, mover.radius_m, solid.outline));
  });

  scene.visitMoving(startOf(path), reachOfMeeting(robot, path), [&](BodyId body) {
    const std::size_t other = scene.movingIndex(body);
    if (other == robot) return;
    has_company_[robot] = 1;
    if (!movers_[other].heights.overlaps(mover.heights)) return;
    const Circle disc{startOf(paths[other]), movers_[other].radius_m};
    path.end_fraction = std::min(path.end_fraction, firstContact(path, mover.radius_m, disc));
  });
}

bool Authority::meetsAnother(const Scene& scene, std::size_t robot, std::span<const Path> paths) const {
  const Path& path = paths[robot];
  // Against those that stand still, (a) has clipped the path already; and a stay would be no news to one of these.
  if (path.clippedLength() == 0 || !has_company_[robot]) return false;
  const Mover& mover = movers_[robot];
  bool meets = false;
  scene.visitMoving(startOf(path), reachOfMeeting(robot, path), [&](BodyId body) {
    const std::size_t other = scene.movingIndex(body);
    meets = meets ||
            (other != robot && paths[other].clippedLength() != 0 && movers_[other].heights.overlaps(mover.heights) &&
             meet(path, mover.radius_m, paths[other], movers_[other].radius_m));
  });
  return meets;
}

}  // namespace robosim
