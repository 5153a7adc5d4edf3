#pragma once
#include <span>
#include <string>

#include <mrpt/math/TPose2D.h>
#include <pybind11/numpy.h>

#include "robots/fleet.h"

namespace robosim {

/// Plan of a world with its robots at some poses: uint8, shape (height, width, 3): red, green, blue.
pybind11::array planOf(const World& world, const Fleet& fleet, std::span<const mrpt::math::TPose2D> world_from_robot);
/// The same as an SVG document.
std::string svgOf(const World& world, const Fleet& fleet, std::span<const mrpt::math::TPose2D> world_from_robot);
/// A JPEG file's picture in that form. @throws std::invalid_argument when it cannot be decoded
pybind11::array pictureOf(const std::string& jpeg);

}  // namespace robosim
