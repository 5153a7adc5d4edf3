#pragma once
#include <span>
#include <string>
#include <vector>

#include "geometry/ray.h"
#include "geometry/solid.h"

namespace robosim {

/// The plainest way to cast level rays: each against every solid, by the formulas of a school book. What the fast ones
/// are held against.
class RayTruth {
 public:
  /// Casts the rays once, without a range.
  RayTruth(std::span<const Solid> solids, std::vector<Ray> rays);

  std::size_t size() const { return rays_.size(); }

  /// Whether `distance_m` (the range when nothing was met) is right for ray `i` to within `tolerance_m`. Where an
  /// answer jumps, for a ray that just grazes an outline, whatever the solids would give if they were larger or smaller
  /// by no more than the tolerance is right too.
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
