#pragma once
#include <vector>

#include "geometry/shapes/planar_transform.h"
#include "geometry/shapes/ray.h"
#include "hardware/measurement.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Origins and directions of thin beams, robot frame, before panning: structure of arrays, so that loops over beams are
/// vectorised.
struct BeamFields {
  std::vector<double> x, y, z, dx, dy, dz;

  void add(const Ray& beam);
};

/// Computes the echo of each beam, panned by the rotation of `pan`, from the distance of its hit. A distance of
/// range_max_m or more gives no echo.
/// @param info specifies the ranges
void setEchoes(const BeamFields& beams, const SensorInfo& info, const PlanarTransform& pan,
               const std::vector<double>& hit_m, Echoes& echoes);

}  // namespace robosim
