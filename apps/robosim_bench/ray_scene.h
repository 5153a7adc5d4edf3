#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/ray.h"
#include "geometry/shapes/solid.h"

namespace robosim {

/// Scene of the workload `rays`: planar rays among 500 boxes and 500 cylinders of 0.1 m … 0.6 m half-width in a square
/// of 100 m. No ray starts inside a solid.
struct RayScene {
  static constexpr double kHalf_m = 50;
  static constexpr double kHeight_m = 0.5;  ///< of the rays; solids reach from 0 to 1 m
  static constexpr std::size_t kBeams = 181;

  std::vector<Solid> solids;
  std::vector<mrpt::math::TPose2D> world_from_scanner;  ///< by scan
  std::vector<Ray> beams;                               ///< of all scans, scan by scan
  std::vector<Ray> singles;                             ///< random origins and directions
};

/// Angle [rad] of beam `i` of the 181 of a scan: from -90° to 90° in steps of 1°, relative to the scanner's heading.
double beamAngle(std::size_t i);

/// @param places number of scans; the number of single rays equals their number of beams
RayScene makeRayScene(std::size_t places, std::uint64_t seed);

}  // namespace robosim
