#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/shapes/ray.h"
#include "sensors/sensor.h"

namespace robosim {

/// Rays of a scan, each at the pose that a moving robot had when the ray was sent.
class SweptRays {
 public:
  /// @param beams planar, robot frame, before panning, in the order in which they are sent
  explicit SweptRays(std::span<const Ray> beams);

  /// @param now pose at the time step
  /// @param first_shares age of the first pose of each revolution, in durations of the last motion; ray i is sent in
  /// revolution i modulo their number, 1 or 2
  /// @param step_share by which each pose of a revolution is younger than that for the ray before
  /// @param to the rays in the world, then unused ones
  void place(const PlanarTransform& now, const Motion& last_motion, double pan_rad,
             std::span<const double> first_shares, double step_share, std::vector<Ray>& to) const;

 private:
  std::size_t count_;
  double z_m_ = 0;
  /// Four rays at a time, the last ones repeated: x and y of the origins, then of the directions.
  std::vector<double> fields_;
};

}  // namespace robosim
