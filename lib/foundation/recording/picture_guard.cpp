#include "recording/picture_guard.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include "base/jpeg_file.h"

namespace robosim {
namespace {

/// A JPEG file of one gray pixel.
std::string makePictureForDamaged() {
  const auto bytes = [](std::initializer_list<int> values) {
    std::string text;
    for (const int value : values) text += static_cast<char>(value);
    return text;
  };
  return bytes({0xff, 0xd8, 0xff, 0xdb, 0, 0x43, 0}) + std::string(64, '\x01') +               // quantisation
         bytes({0xff, 0xc0, 0, 0x11, 8, 0, 1, 0, 1, 3}) +                                      // 1 × 1 pixels,
         bytes({'R', 0x11, 0, 'G', 0x11, 0, 'B', 0x11, 0}) +                                   // of three channels
         bytes({0xff, 0xc4, 0, 0x14, 0, 1}) + std::string(16, '\0') +                          // Huffman code of the
         bytes({0xff, 0xc4, 0, 0x14, 0x10, 1}) + std::string(16, '\0') +                       // mean and of the rest
         bytes({0xff, 0xda, 0, 12, 3, 'R', 0, 'G', 0, 'B', 0, 0, 0x3f, 0, 0x03, 0xff, 0xd9});  // the scan
}

const std::string& pictureForDamaged() {
  static const std::string bytes = makePictureForDamaged();
  return bytes;
}

bool isForDamaged(const mrpt::img::CImage& image) {
  return !image.isExternallyStored() && !image.isEmpty() && image.getWidth() == 1 && image.getHeight() == 1;
}

/// CImage in any namespace; CMRPTImage is its oldest name.
bool isPictureClass(std::string_view name) {
  return name == "CImage" || name.ends_with("::CImage") || name == "CMRPTImage";
}

std::int64_t integerIn(const std::uint8_t* bytes, std::size_t size) {
  std::int32_t number = 0;
  std::memcpy(&number, bytes, std::min(size, sizeof number));
  return number;
}

/// Bytes per pixel of MRPT's PixelDepth: D8U, D8S, D16U, D16S, D32S, D32F, D64F.
std::int64_t bytesOfDepth(std::int64_t depth) {
  constexpr std::int64_t kBytes[] = {1, 1, 2, 2, 4, 4, 8};
  return depth >= 0 && depth < std::ssize(kBytes) ? kBytes[depth] : 0;
}

}  // namespace

void PictureGuard::beginEntry() {
  next_ = Next::other;
  name_size_ = 0;
  fault_.clear();
}

void PictureGuard::inspect(std::uint8_t* bytes, std::size_t size) {
  switch (next_) {
    case Next::other:
      return inspectOther(bytes, size);
    case Next::version:
      version_ = static_cast<int>(integerIn(bytes, size));
      numbers_.clear();
      if (version_ == 0) throw std::runtime_error("a picture is of the version 0 of 2005, which is not read");
      next_ = version_ > 9 ? Next::other : version_ >= 6 ? Next::is_external : Next::has_color;
      if (version_ == 1) next_ = Next::size;
      return;
    case Next::is_external:
      next_ = bytes[0] != 0 ? Next::other : Next::has_color;
      return;
    case Next::has_color:
      next_ = bytes[0] == 0 ? Next::gray : version_ >= 7 ? Next::color : Next::size;
      return;
    case Next::gray:
      numbers_.push_back(integerIn(bytes, size));
      if (numbers_.size() < (version_ >= 9 ? 5 : 4)) return;
      checkGray();
      next_ = Next::other;
      return;
    case Next::color:
      numbers_.push_back(integerIn(bytes, size));
      if (numbers_.size() == 2) next_ = numbers_[0] >= 1 && numbers_[1] >= 1 ? Next::size : Next::other;
      return;
    case Next::size:
      next_ = Next::jpeg;
      return;
    case Next::jpeg:
      inspectJpeg(bytes, size);
      next_ = Next::other;
      return;
  }
}

/// Every object begins with the size of its class name (1 byte, followed by 3 in files before MRPT 0.5) and the name.
void PictureGuard::inspectOther(const std::uint8_t* bytes, std::size_t size) {
  if (size == 1) {
    name_size_ = bytes[0] & 0x7f;
    return;
  }
  if (size == 3 && name_size_ != size) return;
  const bool is_name = size == name_size_;
  name_size_ = 0;
  if (is_name && isPictureClass({reinterpret_cast<const char*>(bytes), size})) next_ = Next::version;
}

/// Width, height, origin, number of bytes, and the depth.
void PictureGuard::checkGray() const {
  const std::int64_t pixel_bytes = version_ >= 9 ? bytesOfDepth(numbers_[4]) : 1;
  if (numbers_[0] >= 0 && numbers_[1] >= 0 && numbers_[3] <= numbers_[0] * numbers_[1] * pixel_bytes) return;
  throw std::runtime_error("a picture has more bytes than pixels");
}

void PictureGuard::inspectJpeg(std::uint8_t* bytes, std::size_t size) {
  const std::string fault = jpegFault({reinterpret_cast<const char*>(bytes), size});
  if (fault.empty()) return;
  if (fault_.empty()) fault_ = fault;
  if (size < pictureForDamaged().size()) throw std::runtime_error("a picture is damaged: " + fault);
  std::copy(pictureForDamaged().begin(), pictureForDamaged().end(), bytes);
}

bool PictureGuard::isDamaged(const mrpt::obs::CObservation& observation) const {
  if (fault_.empty()) return false;
  if (const auto* one = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation)) {
    return isForDamaged(one->image);
  }
  if (const auto* pair = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation)) {
    return isForDamaged(pair->imageLeft) || isForDamaged(pair->imageRight) || isForDamaged(pair->imageDisparity);
  }
  if (const auto* depth = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation)) {
    return isForDamaged(depth->intensityImage) || isForDamaged(depth->confidenceImage);
  }
  return false;
}

}  // namespace robosim
