#pragma once
#include <optional>
#include <vector>

#include <mrpt/math/TPose3D.h>

#include "hardware/sensor_info.h"

namespace robosim {

/// Geometry of evenly spaced beams with a common origin, rotated about the vertical axis, as required by MRPT's 2D
/// scans.
struct ScanGeometry {
  mrpt::math::TPose3D robot_from_middle;  ///< x axis along the middle of the scan
  double step_rad = 0;                    ///< from a beam to the next; negative for clockwise
  double aperture_rad = 0;                ///< from the first beam to the last, (0, 2π]
};

/// Geometry of a sensor's beams; nullopt for a single beam and for beams that do not form such a scan.
std::optional<ScanGeometry> toScanGeometry(const std::vector<Beam>& beams);

/// Pose of a beam of a sensor that is panned by `pan_rad` about its own vertical axis.
mrpt::math::TPose3D panned(mrpt::math::TPose3D robot_from_beam, double pan_rad);

}  // namespace robosim
