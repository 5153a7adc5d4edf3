#include "pictures.h"

#include <stdexcept>

#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/temporary_directory.h"
#include "rendering/plan.h"
#include "rendering/svg_plan.h"

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

cv::Mat drawn(const World& world, const Fleet& fleet, std::span<const mrpt::math::TPose2D> world_from_robot) {
  const py::gil_scoped_release no_python;
  const TemporaryDirectory folder;
  const auto png = folder / "plan.png";
  writePlan(png, world, fleet, {}, world_from_robot);
  return cv::imread(png.string(), cv::IMREAD_COLOR);
}

}  // namespace

py::array planOf(const World& world, const Fleet& fleet, std::span<const mrpt::math::TPose2D> world_from_robot) {
  return rgbOf(drawn(world, fleet, world_from_robot));
}

std::string svgOf(const World& world, Fleet fleet, std::span<const mrpt::math::TPose2D> world_from_robot) {
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    fleet.robots[i].world_from_start = fleet.robots[i].body.world_from_body = world_from_robot[i];
  }
  return toSvg(world, fleet);
}

py::array pictureOf(const std::string& jpeg) {
  const cv::Mat bytes(1, static_cast<int>(jpeg.size()), CV_8U, const_cast<char*>(jpeg.data()));
  const cv::Mat picture = cv::imdecode(bytes, cv::IMREAD_COLOR);
  if (picture.empty()) throw std::invalid_argument("the camera picture is no JPEG file that can be decoded");
  return rgbOf(picture);
}

}  // namespace robosim
