#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/scene.h"
#include "sensors/floor_picture.h"

namespace robosim {

/// Red, green, blue, 8 bits each.
using Rgb = std::array<std::uint8_t, 3>;

/// Appearance of a body of a Scene. All of its surface has one colour.
struct SurfaceLook {
  Rgb color{128, 128, 128};
  bool glows = false;  ///< shows its colour without shading, such as LEDs and hot objects
  bool operator==(const SurfaceLook&) const = default;
};

/// An area that is painted on the floor.
struct FloorArea {
  Outline outline;  ///< world frame
  Rgb color{128, 128, 128};
};

/// Appearance of the floor, the plane z = 0 of the world frame: a checkerboard with fields of 1 m between whole metres,
/// plain ground beyond `bounds`, and what is painted on it.
struct FloorLook {
  Bounds2D bounds;
  std::vector<FloorArea> areas;                 ///< the last one is on top
  std::span<const FloorPicture> pictures = {};  ///< on top of all areas; the last one is on top
};

/// What a ray-cast camera sees. References what it is made of.
struct SeenScene {
  const Scene& scene;
  std::span<const SurfaceLook> looks;  ///< by body; bodies beyond its end have the default
  const FloorLook& floor;
};

/// Pixels of a ray-cast camera, row by row from the upper left. Layers that were not requested are empty.
struct RaycastPicture {
  /// @name Values of `body` for pixels that show no body
  ///@{
  static constexpr std::uint32_t kSky = 0xffffffff;  ///< the sky, or whatever is beyond the camera's range
  static constexpr std::uint32_t kFloor = 0xfffffffe;
  ///@}

  std::uint32_t width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgb;  ///< three bytes per pixel
  /// Distance along the optical axis [m], rounded to single precision; 0 where `body` is kSky. MRPT's
  /// CObservation3DRangeScan with range_is_depth.
  std::vector<float> depth_m;
  std::vector<std::uint32_t> body;  ///< BodyId, kFloor or kSky
};

/// Layers and range of a ray-cast camera.
struct RaycastOptions {
  bool has_rgb = true;
  bool has_depth = false;
  bool has_body = false;
  /// Largest depth [m] that is seen, > 0: a pixel whose ray hits nothing nearer shows the sky above the horizon, haze
  /// below.
  double range_max_m = std::numeric_limits<double>::infinity();
};

}  // namespace robosim
