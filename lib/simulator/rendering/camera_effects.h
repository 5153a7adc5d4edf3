#pragma once
#include <cstdint>

#include <opencv2/core/mat.hpp>

#include "sensors/image_source.h"

namespace robosim {

/// Pinhole camera that covers what a camera with its errors shows: of the same focal length and optical axis, with as
/// many more pixels as the lens and the rolling shutter need. The size is at most kPictureSideMax_px; what lies beyond
/// is black.
/// @param multiple_px of which its sides are, or of which they are one more; even
CameraInfo pinholeFor(const CameraView& camera, std::uint32_t multiple_px = 2);

/// Turns a picture of pinholeFor() into that of the camera: lens and rolling shutter (a row that is read earlier shows
/// the scene from the heading at that time), then exposure, then noise.
/// @param turn_radps of the robot, about the vertical; the optical axis is assumed to be level
/// @param seed of the random numbers
cv::Mat withCameraErrors(const cv::Mat& pinhole, const CameraView& camera, double turn_radps, std::uint64_t seed);

}  // namespace robosim
