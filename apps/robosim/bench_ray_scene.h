#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "geometry/ray.h"
#include "geometry/solid.h"

namespace robosim {

/// What the workload `rays` casts: level rays over 500 boxes and 500 cylinders of 0.1 m … 0.6 m half-width in a square
/// of 100 m. No ray starts inside a solid.
struct RayScene {
  static constexpr double kHalf_m = 50;
  static constexpr double kHeight_m = 0.5;  ///< of the rays; solids reach from 0 to 1 m
  static constexpr std::size_t kBeams = 181;

  std::vector<Solid> solids;
  std::vector<mrpt::math::TPose2D> world_from_scanner;  ///< one each scan
  std::vector<Ray> beams;                               ///< of all scans, scan by scan
  std::vector<Ray> singles;                             ///< from anywhere towards anywhere
};

/// Beam `i` of a scan's 181, a degree apart, from -90° to 90° of where the scanner looks [rad].
double beamAngle(std::size_t i);

/// @param places so many scans, and as many single rays as those have beams
RayScene makeRayScene(std::size_t places, std::uint64_t seed);

}  // namespace robosim
