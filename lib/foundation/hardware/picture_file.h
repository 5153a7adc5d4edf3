#pragma once
#include <string>

#include "hardware/measurement.h"

namespace robosim {

/// Quality of the JPEG files of ray-cast pictures, [1, 100].
constexpr int kRaycastJpegQuality = 90;

/// A JPEG file of a picture, which is encoded here if it is ray-cast (RawPicture::viewedColors()); empty without one.
std::string jpegOf(const Image& image);

}  // namespace robosim
