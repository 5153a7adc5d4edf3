#include "maze/surface_map.h"

#include <cmath>

namespace robosim {
namespace {

constexpr double kSameSide = 0.8;  // cosine of the largest angle between normals of one surface
constexpr int kSeenRepeatedly = 3;
constexpr int kCountMax = 30;  // a patch follows later points by 1 / kCountMax: the first ones have the least drift
constexpr int kMargin = 40;    // cells

}  // namespace

void SurfaceMap::add(const SurfacePoint& added) {
  const Cell cell = cells_.cellAt(added.point_m);
  if (!cells_.contains(cell)) {
    cells_.cover({cell.x - kMargin, cell.y - kMargin}, {cell.x + kMargin, cell.y + kMargin});
    if (!cells_.contains(cell)) return;
  }
  for (std::int32_t i = cells_[cell].first; i >= 0; i = patches_[static_cast<std::size_t>(i)].next) {
    Patch& patch = patches_[static_cast<std::size_t>(i)];
    if (dot(patch.normal, added.normal) < kSameSide) continue;
    patch.count = std::min(patch.count + 1, kCountMax);
    const double share = 1.0 / patch.count;
    patch.point += (added.point_m - patch.point) * share;
    patch.normal += (added.normal - patch.normal) * share;
    patch.normal *= 1 / std::sqrt(dot(patch.normal, patch.normal));
    return;
  }
  patches_.push_back({added.point_m, added.normal, 1, cells_[cell].first});
  cells_[cell].first = static_cast<std::int32_t>(patches_.size()) - 1;
}

std::optional<SurfacePoint> SurfaceMap::nearest(const SurfacePoint& point) const {
  const Cell center = cells_.cellAt(point.point_m);
  std::optional<SurfacePoint> best;
  double best_distance = 0;
  for (int y = center.y - 2; y <= center.y + 2; ++y) {
    for (int x = center.x - 2; x <= center.x + 2; ++x) {
      if (!cells_.contains({x, y})) continue;
      for (std::int32_t i = cells_[{x, y}].first; i >= 0; i = patches_[static_cast<std::size_t>(i)].next) {
        const Patch& patch = patches_[static_cast<std::size_t>(i)];
        if (patch.count < kSeenRepeatedly || dot(patch.normal, point.normal) < kSameSide) continue;
        const mrpt::math::TPoint2D off = point.point_m - patch.point;
        const double along = dot(off, patch.normal);
        // Mostly the distance from the patch's line; a little that along it, to prefer the patch beside the point.
        const double distance = along * along + 0.1 * dot(off, off);
        if (best && distance >= best_distance) continue;
        best_distance = distance;
        best = {patch.point, patch.normal, 0};
      }
    }
  }
  return best;
}

void SurfaceMap::reset() {
  cells_.reset();
  patches_.clear();
}

}  // namespace robosim
