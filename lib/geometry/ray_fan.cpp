#include "geometry/ray_fan.h"

#include <algorithm>
#include <cmath>

namespace robosim {

RayFan::RayFan(std::span<const Ray> rays) : size_(rays.size()) {
  if (rays.empty()) return;
  z_m_ = rays.front().origin.z;
  for (const auto& ray : rays) middle_ += {ray.origin.x, ray.origin.y};
  middle_ *= 1.0 / static_cast<double>(size_);
  for (const auto& ray : rays) {
    spread_m_ = std::max(spread_m_, (mrpt::math::TPoint2D(ray.origin.x, ray.origin.y) - middle_).norm());
  }

  const std::size_t padded = (size_ + kBlock - 1) / kBlock * kBlock;
  for (std::size_t i = 0; i < padded; ++i) {
    const Ray& ray = rays[std::min(i, size_ - 1)];
    x_.push_back(ray.origin.x);
    y_.push_back(ray.origin.y);
    dx_.push_back(ray.direction.x);
    dy_.push_back(ray.direction.y);
  }
  for (std::size_t first = 0; first < padded; first += kBlock) {
    Cone cone;
    const std::size_t last = first + kBlock - 1;
    cone.middle = {dx_[first] + dx_[last], dy_[first] + dy_[last]};
    const double length = cone.middle.norm();
    cone.middle = length > 1e-6 ? cone.middle * (1 / length) : mrpt::math::TPoint2D(dx_[first], dy_[first]);
    double least_cos = 1;
    for (std::size_t i = first; i <= last; ++i) {
      least_cos = std::min(least_cos, cone.middle.x * dx_[i] + cone.middle.y * dy_[i]);
    }
    is_narrow_ = is_narrow_ && least_cos > 0.8;
    cone.cos = std::max(0.0, least_cos - 1e-9);
    cone.sin = std::sqrt(1 - cone.cos * cone.cos);
    cones_.push_back(cone);
  }
}

}  // namespace robosim
