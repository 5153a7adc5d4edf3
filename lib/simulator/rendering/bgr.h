#pragma once
#include <opencv2/core/types.hpp>

#include "rendering/color.h"

namespace robosim {

/// The color as OpenCV draws it: blue, green, red, each from 0 to 255.
inline cv::Scalar bgr(const Color& color) { return {color[2] * 255.0, color[1] * 255.0, color[0] * 255.0}; }

}  // namespace robosim
