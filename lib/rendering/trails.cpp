#include "rendering/trails.h"

namespace robosim {

namespace {

/// Drops every second point, but none that follows a gap. If too many points remain, drops the older half.
void thin(std::vector<TrailPoint>& trail, std::size_t max_points) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < trail.size(); ++i) {
    if (i % 2 == 0 || trail[i].is_after_gap) trail[kept++] = trail[i];
  }
  trail.resize(kept);
  if (kept >= max_points) trail.erase(trail.begin(), trail.begin() + static_cast<std::ptrdiff_t>(kept / 2));
}

}  // namespace

void Trails::add(const RunSnapshot& snapshot) {
  constexpr double kSpacing_m = 0.05, kKnown_m = 1;
  // A recording may be rewound.
  if (snapshot.step < last_step_) clear();
  const bool has_skipped = snapshot.step > last_step_ + 1;
  last_step_ = snapshot.step;
  of_robot_.resize(snapshot.robots.size());
  spacing_m_.resize(snapshot.robots.size(), kSpacing_m);
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    auto& trail = of_robot_[i];
    const mrpt::math::TPoint2D now(snapshot.robots[i].world_from_robot.x, snapshot.robots[i].world_from_robot.y);
    const double way_m = trail.empty() ? 0 : (now - trail.back().at).norm();
    if (!trail.empty() && way_m < spacing_m_[i]) continue;
    if (trail.size() >= max_points_) {
      thin(trail, max_points_);
      spacing_m_[i] *= 2;
    }
    trail.push_back({now, has_skipped && way_m > kKnown_m});
  }
}

}  // namespace robosim
