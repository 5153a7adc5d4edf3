#pragma once
#include <optional>
#include <vector>

#include <mrpt/math/TPose3D.h>

#include "hardware/sensor_info.h"

namespace robosim {

/// Beams that start at one place and turn evenly about the vertical, as MRPT's 2D scans want them.
struct Fan {
  mrpt::math::TPose3D robot_from_middle;  ///< looks along the middle of the fan
  double step_rad = 0;                    ///< from a beam to the next; negative for clockwise
  double aperture_rad = 0;                ///< from the first beam to the last, (0, 2π]
};

/// nullopt for a single beam and for beams that are no fan.
std::optional<Fan> fanOf(const std::vector<Beam>& beams);

/// The beam of a sensor that has turned by `pan_rad` about its own vertical.
mrpt::math::TPose3D panned(mrpt::math::TPose3D robot_from_beam, double pan_rad);

}  // namespace robosim
