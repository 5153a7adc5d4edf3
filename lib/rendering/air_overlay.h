#pragma once
#include <mrpt/math/TPose3D.h>
#include <opencv2/core/mat.hpp>

#include "hardware/sensor_info.h"
#include "rendering/run_paths.h"
#include "rendering/top_view.h"
#include "robots/fleet.h"

namespace robosim {

/// Draws robot paths and echo points onto a rendered 3D picture, without occlusion. Used for worlds of which only the
/// robots are known: recordings made by other programs.
/// @param picture BGR, of the camera's size
/// @param world_from_camera x along the optical axis, z up
void drawAirOverlay(cv::Mat& picture, const CameraInfo& camera, const mrpt::math::TPose3D& world_from_camera,
                    const RunSnapshot& snapshot, const Fleet& fleet, const RunPaths& paths,
                    const TopViewLayers& layers);

}  // namespace robosim
