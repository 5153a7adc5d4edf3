#include "geometry/ray_fan.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// Rounding may turn a ray aside by as much.
constexpr double kSlack_rad = 1e-9;

TPoint2D facingOf(std::span<const Ray> rays) {
  TPoint2D sum;
  for (const auto& ray : rays) sum += {ray.direction.x, ray.direction.y};
  if (sum.norm() < 1e-3) return {};
  sum *= 1 / sum.norm();
  const bool all_ahead = std::all_of(rays.begin(), rays.end(), [&](const Ray& ray) {
    return sum.x * ray.direction.x + sum.y * ray.direction.y >= -kSlack_rad;
  });
  return all_ahead ? sum : TPoint2D();
}

}  // namespace

RayFan::RayFan(std::span<const Ray> rays) : size_(rays.size()), bearings_(rays) {
  if (rays.empty()) return;
  z_m_ = rays.front().origin.z;
  for (const auto& ray : rays) middle_ += {ray.origin.x, ray.origin.y};
  middle_ *= 1.0 / static_cast<double>(size_);
  for (const auto& ray : rays) {
    spread_m_ = std::max(spread_m_, (TPoint2D(ray.origin.x, ray.origin.y) - middle_).norm());
  }
  facing_ = facingOf(rays);

  const std::size_t padded = (size_ + kBlock - 1) / kBlock * kBlock;
  for (std::size_t i = 0; i < padded; ++i) {
    const Ray& ray = rays[std::min(i, size_ - 1)];
    x_.push_back(ray.origin.x);
    y_.push_back(ray.origin.y);
    dx_.push_back(ray.direction.x);
    dy_.push_back(ray.direction.y);
  }
}

}  // namespace robosim
