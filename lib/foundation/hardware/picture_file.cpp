#include "hardware/picture_file.h"

#include "base/jpeg_file.h"

namespace robosim {

std::string jpegOf(const Image& image) {
  if (!image.raw) return image.jpeg;
  return encodeJpeg({image.raw->width_px, image.raw->height_px, 3, image.raw->viewedColors()}, kRaycastJpegQuality);
}

}  // namespace robosim
