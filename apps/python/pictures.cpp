#include "pictures.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "base/jpeg_file.h"
#include "file_functions.h"
#include "python_released.h"

namespace robosim {
namespace {

namespace py = pybind11;

py::array_t<std::uint8_t> rgbOf(std::size_t rows, std::size_t columns) {
  return py::array_t<std::uint8_t>({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns), py::ssize_t{3}});
}

/// @param channels of each pixel; empty for one
template <typename T>
py::object pixelsOf(const RawPicture& picture, const std::vector<T>& values, const std::vector<py::ssize_t>& channels) {
  if (values.empty()) return py::none();
  std::vector<py::ssize_t> shape{py::ssize_t{picture.height_px}, py::ssize_t{picture.width_px}};
  shape.insert(shape.end(), channels.begin(), channels.end());
  return py::array_t<T>(shape, values.data());
}

}  // namespace

py::array planOf(const World& world, const Fleet& fleet, std::span<const mrpt::math::TPose2D> world_from_robot) {
  const RgbPicture picture = [&] {
    const PythonReleased no_python;
    return fileFunctions().plan(world, fleet, world_from_robot);
  }();
  py::array_t<std::uint8_t> rgb = rgbOf(picture.rows, picture.columns);
  std::copy(picture.values.begin(), picture.values.end(), rgb.mutable_data());
  return rgb;
}

std::string svgOf(const World& world, const Fleet& fleet, std::span<const mrpt::math::TPose2D> world_from_robot) {
  const PythonReleased no_python;
  return fileFunctions().plan_svg(world, fleet, world_from_robot);
}

py::object pictureOf(const Image& image) {
  if (image.isEmpty()) return py::none();
  if (image.raw) return pixelsOf(*image.raw, image.raw->viewedColors(), {3});
  std::string fault;
  const JpegPicture picture = decodeJpeg(image.jpeg, fault);
  if (!fault.empty()) throw std::invalid_argument("the camera picture cannot be decoded: " + fault);
  py::array_t<std::uint8_t> rgb = rgbOf(picture.rows, picture.columns);
  std::uint8_t* out = rgb.mutable_data();
  const std::size_t repeats = 3 / picture.channels;  // a gray value stands for all three
  for (const std::uint8_t value : picture.values) out = std::fill_n(out, repeats, value);
  return rgb;
}

py::object depthsOf(const Image& image) {
  return image.raw ? pixelsOf(*image.raw, image.raw->depth_m, {}) : py::object(py::none());
}

py::object identitiesOf(const Image& image) {
  return image.raw ? pixelsOf(*image.raw, image.raw->identity, {}) : py::object(py::none());
}

}  // namespace robosim
