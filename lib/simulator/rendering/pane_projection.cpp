#include "rendering/pane_projection.h"

#include <cmath>

#include "rendering/air_view.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

/// Where lines of sight from above begin [m].
constexpr double kAboveAll_m = 1e6;

}  // namespace

PaneProjection::PaneProjection(const GroundView& view, const TPoint2D& corner_px, double scale)
    : how_(Above{view, scale}), corner_px_(corner_px) {}

PaneProjection::PaneProjection(const CameraInfo& camera, const mrpt::math::TPose3D& world_from_camera,
                               const TPoint2D& corner_px)
    : how_(Perspective{
          world_from_camera, {(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0}, camera.focalLength()}),
      corner_px_(corner_px) {}

Ray PaneProjection::sightThrough(const TPoint2D& pixel) const {
  const TPoint2D in_pane = pixel - corner_px_;
  if (const auto* above = std::get_if<Above>(&how_)) {
    const TPoint2D at = above->view.toWorld(in_pane * (1 / above->scale));
    return {{at.x, at.y, kAboveAll_m}, {0, 0, -1}};
  }
  const auto& air = std::get<Perspective>(how_);
  const TPoint3D in_camera(1, (air.middle_px.x - in_pane.x) / air.focal_px,
                           (air.middle_px.y - in_pane.y) / air.focal_px);
  TPoint3D ahead;
  air.world_from_camera.composePoint(in_camera * (1 / in_camera.norm()), ahead);
  const TPoint3D origin(air.world_from_camera.x, air.world_from_camera.y, air.world_from_camera.z);
  return {origin, ahead - origin};
}

std::optional<TPoint2D> PaneProjection::onLevel(double z_m, const TPoint2D& pixel) const {
  const Ray sight = sightThrough(pixel);
  const double distance_m = (z_m - sight.origin.z) / sight.direction.z;
  if (!std::isfinite(distance_m) || distance_m <= 0) return std::nullopt;
  const TPoint3D at = sight.at(distance_m);
  return TPoint2D(at.x, at.y);
}

std::optional<TPoint2D> PaneProjection::pixelOf(const TPoint3D& world) const {
  if (const auto* above = std::get_if<Above>(&how_)) {
    return corner_px_ + above->view.toPixel({world.x, world.y}) * above->scale;
  }
  const auto& air = std::get<Perspective>(how_);
  TPoint3D seen;
  air.world_from_camera.inverseComposePoint(world, seen);
  if (seen.x < AirView::kNearest_m) return std::nullopt;
  return corner_px_ + air.middle_px - TPoint2D(seen.y, seen.z) * (air.focal_px / seen.x);
}

double PaneProjection::metresPerPixel() const {
  const auto* above = std::get_if<Above>(&how_);
  return above ? 1 / (above->view.pixelsPerMetre() * above->scale) : 0;
}

}  // namespace robosim
