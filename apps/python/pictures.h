#pragma once
#include <span>
#include <string>

#include <mrpt/math/TPose2D.h>
#include <pybind11/numpy.h>

#include "hardware/measurement.h"
#include "robots/fleet.h"

namespace robosim {

/// Plan of a world with its robots at some poses: uint8, shape (height, width, 3): red, green, blue.
pybind11::array planOf(const World& world, const Fleet& fleet, std::span<const mrpt::math::TPose2D> world_from_robot);
/// The same as an SVG document.
std::string svgOf(const World& world, const Fleet& fleet, std::span<const mrpt::math::TPose2D> world_from_robot);
/// A camera's picture in that form; None without one. @throws std::invalid_argument when it cannot be decoded
pybind11::object pictureOf(const Image& image);
/// The depths of a ray-cast picture: float32, shape (height, width); None without them.
pybind11::object depthsOf(const Image& image);
/// The identities of the bodies in one: uint32, shape (height, width); None without them.
pybind11::object identitiesOf(const Image& image);

}  // namespace robosim
