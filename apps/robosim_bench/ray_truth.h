#pragma once
#include <span>
#include <string>
#include <vector>

#include "geometry/shapes/ray.h"
#include "geometry/shapes/solid.h"

namespace robosim {

/// Reference ray caster: tests each planar ray against every solid (brute force). Used to check the fast ones.
class RayTruth {
 public:
  /// Casts the rays once, with unlimited range.
  RayTruth(std::span<const Solid> solids, std::vector<Ray> rays);

  std::size_t size() const { return rays_.size(); }

  /// Whether `distance_m` (the range for a miss) is correct for ray `i` to within `tolerance_m`. For a ray that grazes
  /// an outline, where the result is discontinuous, any result for solids grown or shrunk by up to the tolerance is
  /// correct too.
  bool agrees(std::size_t i, double distance_m, double range_m, double tolerance_m) const;

  /// Distance [m] to the nearest solid, or infinity.
  double distance(std::size_t i) const { return distance_m_[i]; }

 private:
  double cast(const Ray& ray, double grown_m) const;

  std::span<const Solid> solids_;
  std::vector<Ray> rays_;
  std::vector<double> distance_m_;
};

}  // namespace robosim
