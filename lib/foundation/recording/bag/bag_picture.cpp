#include "recording/bag/bag_picture.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include <opencv2/imgcodecs.hpp>

#include "base/jpeg_file.h"
#include "recording/jpeg_observation.h"

namespace robosim {
namespace {

using mrpt::img::CImage;
using mrpt::obs::CObservation;

/// Largest picture that is decoded [pixels].
constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 26;

void checkSize(std::uint64_t columns, std::uint64_t rows) {
  if (columns > 0 && rows > 0 && columns <= kMaxPixels && rows <= kMaxPixels / columns) return;
  throw std::runtime_error("a picture of " + std::to_string(columns) + " x " + std::to_string(rows) + " pixels");
}

/// Size and order of an uncompressed pixel.
struct PixelFormat {
  const char* encoding;
  int channels;
  bool is_blue_first;
};
constexpr std::array kPixelFormats{PixelFormat{"mono8", 1, false}, PixelFormat{"rgb8", 3, false},
                                   PixelFormat{"bgr8", 3, true},   PixelFormat{"rgba8", 4, false},
                                   PixelFormat{"bgra8", 4, true},  PixelFormat{"8UC1", 1, false},
                                   PixelFormat{"8UC3", 3, true}};

const PixelFormat& formatOf(const std::string& encoding) {
  for (const auto& format : kPixelFormats) {
    if (encoding == format.encoding) return format;
  }
  throw UnknownPictureFormat("pixels in the encoding \"" + encoding + "\"");
}

/// @param values row by row, of `channels` values for each pixel, with `step` bytes for each row
CImage imageOf(std::uint32_t columns, std::uint32_t rows, const PixelFormat& format, const std::uint8_t* values,
               std::size_t step) {
  CImage image(columns, rows, format.channels == 1 ? mrpt::img::CH_GRAY : mrpt::img::CH_RGB);
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::uint8_t* from = values + row * step;
    auto* to = image.ptrLine<std::uint8_t>(row);
    if (format.channels == 1) {
      std::copy(from, from + columns, to);
      continue;
    }
    for (std::uint32_t column = 0; column < columns; ++column, from += format.channels, to += 3) {
      const std::array<std::uint8_t, 3> pixel{from[0], from[1], from[2]};
      to[0] = pixel[format.is_blue_first ? 0 : 2];  // MRPT's order: blue, green, red
      to[1] = pixel[1];
      to[2] = pixel[format.is_blue_first ? 2 : 0];
    }
  }
  return image;
}

/// A PNG file begins with its signature and the chunk of its header. OpenCV tries a dozen formats for other files.
constexpr std::string_view kPngBeginning("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);

CImage decodePng(std::string_view file) {
  constexpr std::size_t kSizeAt = kPngBeginning.size(), kHeaderEnd = kSizeAt + 8;
  if (!file.starts_with(kPngBeginning) || file.size() < kHeaderEnd) {
    throw std::runtime_error("a PNG file without its header");
  }
  const auto number = [&](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(file[at + i]);
    return value;
  };
  checkSize(number(kSizeAt), number(kSizeAt + 4));
  const cv::Mat bytes(1, static_cast<int>(file.size()), CV_8U, const_cast<char*>(file.data()));  // only read
  cv::Mat decoded;
  try {
    decoded = cv::imdecode(bytes, cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
  }
  if (decoded.empty()) throw std::runtime_error("a damaged PNG file");
  return CImage(decoded, mrpt::img::DEEP_COPY);
}

void setCamera(mrpt::obs::CObservationImage& picture, const std::optional<ros::CameraInfo>& info,
               const mrpt::poses::CPose3D& robot_from_optical) {
  picture.cameraPose = robot_from_optical;
  auto& camera = picture.cameraParams;
  camera.ncols = static_cast<std::uint32_t>(picture.image.getWidth());
  camera.nrows = static_cast<std::uint32_t>(picture.image.getHeight());
  if (!info || !(info->k[0] > 0)) return;
  camera.ncols = info->width;
  camera.nrows = info->height;
  camera.setIntrinsicParamsFromValues(info->k[0], info->k[4], info->k[2], info->k[5]);
  const auto& d = info->d;
  if (info->distortion_model == "plumb_bob" && d.size() >= 5 && (d[0] != 0 || d[1] != 0 || d[2] != 0 || d[3] != 0)) {
    camera.setDistortionPlumbBob(d[0], d[1], d[2], d[3], d[4]);
  }
}

}  // namespace

CObservation::Ptr pictureObservation(const ros::CompressedImage& picture, const std::optional<ros::CameraInfo>& camera,
                                     const mrpt::poses::CPose3D& robot_from_optical) {
  const std::string_view file(reinterpret_cast<const char*>(picture.data.data()), picture.data.size());
  std::shared_ptr<mrpt::obs::CObservationImage> made;
  if (file.starts_with("\xff\xd8")) {
    std::string fault;
    const JpegPicture decoded = decodeJpeg(file, fault);
    if (!fault.empty()) throw std::runtime_error("a damaged JPEG file: " + fault);
    checkSize(decoded.columns, decoded.rows);
    const PixelFormat& format = formatOf(decoded.channels == 1 ? "mono8" : "rgb8");
    auto with_file = std::make_shared<JpegObservation>();
    with_file->image = imageOf(decoded.columns, decoded.rows, format, decoded.values.data(),
                               std::size_t{decoded.columns} * decoded.channels);
    with_file->jpeg = file;
    made = with_file;
  } else if (file.starts_with("\x89PNG")) {
    made = mrpt::obs::CObservationImage::Create();
    made->image = decodePng(file);
  } else {
    throw UnknownPictureFormat("a picture of the format \"" + picture.format + "\"");
  }
  setCamera(*made, camera, robot_from_optical);
  return made;
}

CObservation::Ptr pictureObservation(const ros::Image& picture, const std::optional<ros::CameraInfo>& camera,
                                     const mrpt::poses::CPose3D& robot_from_optical) {
  const PixelFormat& format = formatOf(picture.encoding);
  checkSize(picture.width, picture.height);
  const std::size_t row_bytes = std::size_t{picture.width} * static_cast<std::size_t>(format.channels);
  const std::size_t step = picture.step == 0 ? row_bytes : picture.step;
  if (step < row_bytes || picture.data.size() < step * (picture.height - 1) + row_bytes) {
    throw std::runtime_error("fewer bytes than pixels");
  }
  auto made = mrpt::obs::CObservationImage::Create();
  made->image = imageOf(picture.width, picture.height, format, picture.data.data(), step);
  setCamera(*made, camera, robot_from_optical);
  return made;
}

}  // namespace robosim
