#pragma once
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "geometry/ray.h"
#include "geometry/ray_bearings.h"

namespace robosim {

/// Level rays of one height that start near one place, in the frame of what carries them: those of a laser, or of a
/// ring of sonars. What can be worked out once for all times that they are cast (RayBatch) is worked out here. Many
/// rays should go round counter-clockwise: then each solid is held only against those of its bearing.
class RayFan {
 public:
  static constexpr std::size_t kBlock = 16;

  RayFan() = default;
  /// @param rays level (direction.z == 0), all of the same origin.z
  explicit RayFan(std::span<const Ray> rays);

  std::size_t size() const { return size_; }
  std::size_t blocks() const { return x_.size() / kBlock; }
  double z() const { return z_m_; }
  /// In the middle of the rays' origins.
  const mrpt::math::TPoint2D& middle() const { return middle_; }
  /// Distance from there to the farthest origin [m].
  double spread() const { return spread_m_; }
  /// Whether there are many rays that go round: a laser, not a ring of sonars.
  bool isSweep() const { return bearings_.goRound() && size_ > 2 * kBlock; }
  /// Where the fan faces, when no ray looks more than 90° aside of it: a unit vector; (0, 0) for one that looks all
  /// ways.
  const mrpt::math::TPoint2D& facing() const { return facing_; }

 private:
  friend class RayBatch;

  std::size_t size_ = 0;
  double z_m_ = 0;
  mrpt::math::TPoint2D middle_;
  double spread_m_ = 0;
  mrpt::math::TPoint2D facing_;
  std::vector<double> x_, y_, dx_, dy_;  ///< by ray; the last one repeated up to a whole block
  RayBearings bearings_;
};

}  // namespace robosim
