#include "rendering/shown.h"

namespace robosim {

void Trails::add(const Shown& shown) {
  constexpr double kSpacing_m = 0.05;
  // A recording may be wound back.
  if (shown.step < last_step_) of_robot_.clear();
  last_step_ = shown.step;
  of_robot_.resize(shown.robots.size());
  for (std::size_t i = 0; i < shown.robots.size(); ++i) {
    auto& trail = of_robot_[i];
    const mrpt::math::TPoint2D now(shown.robots[i].world_from_robot.x, shown.robots[i].world_from_robot.y);
    if (!trail.empty() && (now - trail.back()).norm() < kSpacing_m) continue;
    // Half at a time, so that it is seldom.
    if (trail.size() >= most_) trail.erase(trail.begin(), trail.begin() + static_cast<std::ptrdiff_t>(most_ / 2));
    trail.push_back(now);
  }
}

}  // namespace robosim
