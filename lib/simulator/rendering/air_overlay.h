#pragma once
#include <optional>
#include <vector>

#include <mrpt/math/TPose3D.h>
#include <opencv2/core/mat.hpp>

#include "hardware/sensor_info.h"
#include "rendering/density_map.h"
#include "rendering/depth_buffer.h"
#include "rendering/run_paths.h"
#include "robots/fleet.h"
#include "robots/view_layers.h"

namespace robosim {

/// A rendered 3D picture that is drawn onto.
struct AirPicture {
  cv::Mat& picture;          ///< BGR, of the camera's size
  const DepthBuffer& depth;  ///< of the picture, or of one a whole number of times as large
  CameraInfo camera;
  mrpt::math::TPose3D world_from_camera;  ///< x along the optical axis, z up
  double scale = 1;                       ///< of lines and text
};

/// Draws paths, measured ranges and names onto a rendered 3D picture. Paths, ranges and echoes are hidden by nearer
/// things (depth test per pixel, or per piece of a line); names are not.
/// @param snapshot absent robots are not drawn
/// @param shown flags of the robots whose readings are drawn; empty for all
/// @param density tints the ground, in place of the dots and paths of many robots
void drawAirOverlay(const AirPicture& air, const RunSnapshot& snapshot, const Fleet& fleet, const RunPaths& paths,
                    const ViewLayers& layers, const std::vector<std::uint8_t>& shown,
                    const std::optional<DensityMap>& density = {});

}  // namespace robosim
