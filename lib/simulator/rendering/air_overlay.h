#pragma once
#include <mrpt/math/TPose3D.h>
#include <opencv2/core/mat.hpp>

#include "hardware/sensor_info.h"
#include "rendering/depth_buffer.h"
#include "rendering/run_paths.h"
#include "rendering/top_view.h"
#include "robots/fleet.h"

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
/// @param shown flags of the robots whose readings are drawn; empty for all
void drawAirOverlay(const AirPicture& air, const RunSnapshot& snapshot, const Fleet& fleet, const RunPaths& paths,
                    const TopViewLayers& layers, const std::vector<std::uint8_t>& shown);

}  // namespace robosim
