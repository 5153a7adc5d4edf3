#pragma once
#include <optional>
#include <variant>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose3D.h>

#include "geometry/shapes/ray.h"
#include "hardware/sensor_info.h"
#include "rendering/ground_view.h"

namespace robosim {

/// How a pane of a picture shows the world. Pixels are those of the whole picture: x to the right, y down.
class PaneProjection {
 public:
  /// From straight above.
  /// @param corner_px the pane's upper left corner in the picture
  /// @param scale pixels of the picture per pixel of the view, > 0
  PaneProjection(const GroundView& view, const mrpt::math::TPoint2D& corner_px, double scale);
  /// In perspective. The camera's x is along the optical axis, z up.
  PaneProjection(const CameraInfo& camera, const mrpt::math::TPose3D& world_from_camera,
                 const mrpt::math::TPoint2D& corner_px);

  bool isFromAbove() const { return std::holds_alternative<Above>(how_); }
  /// The line of sight through a pixel; from above, it begins higher than any object.
  Ray sightThrough(const mrpt::math::TPoint2D& pixel) const;
  /// Where it meets the level plane at a height; nullopt above the horizon.
  std::optional<mrpt::math::TPoint2D> onLevel(double z_m, const mrpt::math::TPoint2D& pixel) const;
  /// nullopt for a point that is not in front of the camera
  std::optional<mrpt::math::TPoint2D> pixelOf(const mrpt::math::TPoint3D& world) const;
  /// Length [m] of a pixel from above; 0 in perspective.
  double metresPerPixel() const;

 private:
  struct Above {
    GroundView view;
    double scale;
  };
  struct Perspective {
    mrpt::math::TPose3D world_from_camera;
    mrpt::math::TPoint2D middle_px;
    double focal_px;
  };

  std::variant<Above, Perspective> how_;
  mrpt::math::TPoint2D corner_px_;
};

}  // namespace robosim
