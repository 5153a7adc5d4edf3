#include "geometry/shapes/sector.h"

#include "base/portable_math.h"
#include "geometry/shapes/ray.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

double cross(const TPoint2D& a, const TPoint2D& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

Sector Sector::towards(const mrpt::math::TPoint3D& apex, double axis_rad, double half_width_rad) {
  const auto unit = [](double angle_rad) {
    const auto [sin, cos] = portable::sincos(angle_rad);
    return TPoint2D(cos, sin);
  };
  return {apex, unit(axis_rad), unit(axis_rad + half_width_rad), unit(axis_rad - half_width_rad)};
}

bool Sector::contains(const TPoint2D& v) const { return cross(right, v) >= 0 && cross(v, left) >= 0; }

std::optional<SectorHit> nearestInSector(const Sector& sector, const Solid& solid) {
  if (!solid.heights.contains(sector.apex.z)) return std::nullopt;
  const TPoint2D apex(sector.apex.x, sector.apex.y);
  const TPoint2D nearest = nearestPoint(solid.outline, apex);
  const TPoint2D towards = nearest - apex;
  if (sector.contains(towards)) return SectorHit{towards.norm(), nearest};

  // Outline and wedge are both convex. If the outline's nearest point lies outside the wedge, the nearest point inside
  // it lies on an edge of the wedge, where that edge enters the outline.
  std::optional<SectorHit> best;
  for (const auto& edge : {sector.left, sector.right}) {
    const auto distance_m = intersect({sector.apex, {edge.x, edge.y, 0}}, solid);
    if (distance_m && (!best || *distance_m < best->distance_m)) best = {*distance_m, apex + edge * *distance_m};
  }
  return best;
}

}  // namespace robosim
