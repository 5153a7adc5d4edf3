#include "pictures.h"

#include <algorithm>
#include <stdexcept>

#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/jpeg_file.h"
#include "python_released.h"
#include "rendering/plan.h"

namespace robosim {
namespace {

namespace py = pybind11;

/// @param picture blue, green, red
py::array rgbOf(const cv::Mat& picture) {
  py::array_t<std::uint8_t> rgb({py::ssize_t{picture.rows}, py::ssize_t{picture.cols}, py::ssize_t{3}});
  std::uint8_t* out = rgb.mutable_data();
  for (int row = 0; row < picture.rows; ++row) {
    const std::uint8_t* pixel = picture.ptr(row);
    for (int column = 0; column < picture.cols; ++column, pixel += 3) {
      for (const int channel : {2, 1, 0}) *out++ = pixel[channel];
    }
  }
  return rgb;
}

cv::Mat decoded(const std::string& file) {
  const cv::Mat bytes(1, static_cast<int>(file.size()), CV_8U, const_cast<char*>(file.data()));
  return cv::imdecode(bytes, cv::IMREAD_COLOR);
}

std::string drawn(PictureFormat format, const World& world, const Fleet& fleet,
                  std::span<const mrpt::math::TPose2D> world_from_robot) {
  const PythonReleased no_python;
  DrawnRun run;
  run.world_from_robot.assign(world_from_robot.begin(), world_from_robot.end());
  return planPicture(format, world, fleet, run);
}

}  // namespace

py::array planOf(const World& world, const Fleet& fleet, std::span<const mrpt::math::TPose2D> world_from_robot) {
  return rgbOf(decoded(drawn(PictureFormat::png, world, fleet, world_from_robot)));
}

std::string svgOf(const World& world, const Fleet& fleet, std::span<const mrpt::math::TPose2D> world_from_robot) {
  return drawn(PictureFormat::svg, world, fleet, world_from_robot);
}

py::array pictureOf(const std::string& jpeg) {
  std::string fault;
  const JpegPicture picture = decodeJpeg(jpeg, fault);
  if (!fault.empty()) throw std::invalid_argument("the camera picture cannot be decoded: " + fault);
  py::array_t<std::uint8_t> rgb({py::ssize_t{picture.rows}, py::ssize_t{picture.columns}, py::ssize_t{3}});
  std::uint8_t* out = rgb.mutable_data();
  const std::size_t repeats = 3 / picture.channels;  // a gray value stands for all three
  for (const std::uint8_t value : picture.values) out = std::fill_n(out, repeats, value);
  return rgb;
}

}  // namespace robosim
