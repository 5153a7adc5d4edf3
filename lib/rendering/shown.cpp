#include "rendering/shown.h"

namespace robosim {

void Trails::add(const Shown& shown) {
  constexpr double kSpacing_m = 0.05, kKnown_m = 1;
  // A recording may be wound back.
  if (shown.step < last_step_) of_robot_.clear();
  const bool has_skipped = shown.step > last_step_ + 1;
  last_step_ = shown.step;
  of_robot_.resize(shown.robots.size());
  for (std::size_t i = 0; i < shown.robots.size(); ++i) {
    auto& trail = of_robot_[i];
    const mrpt::math::TPoint2D now(shown.robots[i].world_from_robot.x, shown.robots[i].world_from_robot.y);
    const double way_m = trail.empty() ? 0 : (now - trail.back().at).norm();
    if (!trail.empty() && way_m < kSpacing_m) continue;
    // Half at a time, so that it is seldom.
    if (trail.size() >= most_) trail.erase(trail.begin(), trail.begin() + static_cast<std::ptrdiff_t>(most_ / 2));
    trail.push_back({now, has_skipped && way_m > kKnown_m});
  }
}

}  // namespace robosim
