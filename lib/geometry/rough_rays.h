#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include <mrpt/math/TPoint2D.h>

#include "geometry/ray_walks.h"
#include "geometry/rough_ray.h"

namespace robosim {

/// The rays of some walks in single precision.
class RoughRays {
 public:
  /// For each ray that goes on, as the walks list them, 8 bits: for the solids of its pack that it passes. The first of
  /// 8 rays has a number's lowest bits.
  using Passed = std::array<std::uint64_t, RayWalks::kMost / RayWalks::kTogether>;

  void set(const RayWalks& walks, const mrpt::math::TPoint2D& middle);
  void findPassed(const RayWalks& walks, const GridIndex::Pack* packs, Passed& passed) const;

 private:
  RoughRay ray(std::size_t i) const { return {x_[i], y_[i], lost_m_[i], dx_[i], dy_[i]}; }

  RayWalks::Field<float> x_, y_, lost_m_, dx_, dy_;
};

}  // namespace robosim
