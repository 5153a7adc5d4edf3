#include "rendering/drawn_run.h"

#include <algorithm>
#include <utility>

namespace robosim {

RunEvents::Last& RunEvents::lastOf(std::size_t robot) {
  if (robot >= last_.size()) last_.resize(robot + 1);
  return last_[robot];
}

void RunEvents::addState(std::size_t robot, bool is_stalled, bool has_found,
                         const std::optional<mrpt::math::TPoint2D>& at, double time_s) {
  Last& last = lastOf(robot);
  const bool begins_to_stall = is_stalled && !std::exchange(last.is_stalled, is_stalled);
  last.is_stalled = is_stalled;
  const bool finds = has_found && !std::exchange(last.has_found, true);
  if (!at) return;
  if (finds) all_.push_back({time_s, {RunEvent::Kind::gold, robot, *at}});
  if (begins_to_stall) all_.push_back({time_s, {RunEvent::Kind::stall, robot, *at}});
}

void RunEvents::addMessage(std::size_t sender, const std::optional<mrpt::math::TPoint2D>& at, double time_s) {
  Last& last = lastOf(sender);
  if (std::exchange(last.message_s, time_s) == time_s || !at) return;
  all_.push_back({time_s, {RunEvent::Kind::message, sender, *at}});
}

void applyLayers(DrawnRun& run, const ViewLayers& layers, const World& world, const Fleet& fleet) {
  run.has_names = layers.names;
  run.has_starts = layers.starts;
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    if (layers.shows(i)) continue;
    if (i < run.paths.size()) run.paths[i].clear();
    if (i < run.path_times_s.size()) run.path_times_s[i].clear();
    if (i < run.world_from_robot.size()) run.world_from_robot[i].reset();
  }
  std::erase_if(run.events, [&](const RunEvent& event) { return !layers.events || !layers.shows(event.robot); });
  std::vector<std::optional<mrpt::math::TPoint2D>> at;
  for (const auto& pose : run.world_from_robot) {
    auto& place = at.emplace_back();
    if (pose) place.emplace(pose->x, pose->y);
  }
  run.density = densityOf(layers, world, fleet, at, run.paths);
  if (!layers.paths) run.paths.clear();
}

DetailLevel detailOf(const World& world, const DrawnRun& run, double px_per_m) {
  const Bounds2D area = areaOf(world, run);
  std::size_t robots = 0;
  for (std::size_t i = 0; i < std::max(run.world_from_robot.size(), run.paths.size()); ++i) {
    const bool is_there = i < run.world_from_robot.size() && run.world_from_robot[i];
    robots += is_there || (i < run.paths.size() && !run.paths[i].empty()) ? 1 : 0;
  }
  return DetailLevel::of(robots, (area.x_max - area.x_min) * (area.y_max - area.y_min) * px_per_m * px_per_m,
                         run.density.has_value());
}

DrawnRun reduced(const World& world, DrawnRun run, double px_per_m) {
  const DetailLevel level = detailOf(world, run, px_per_m);
  if (!level.is_crowded) return run;
  run.has_starts = false;
  run.sensed.clear();
  if (!level.has_paths) run.paths.clear();
  if (!level.has_robots) {
    std::erase_if(run.events, [](const RunEvent& event) { return event.kind != RunEvent::Kind::gold; });
  }
  return run;
}

Bounds2D areaOf(const World& world, const DrawnRun& run) {
  Bounds2D area = world.bounds;
  const auto include = [&](const Bounds2D& b) {
    area = {std::min(area.x_min, b.x_min), std::max(area.x_max, b.x_max), std::min(area.y_min, b.y_min),
            std::max(area.y_max, b.y_max)};
  };
  for (const auto& object : run.objects.orThose(world.objects)) include(boundsOf(object.body.solid().outline));
  for (const auto& map : world.maps) include(boundsOf(map.plan, map.world_from_map));
  for (const auto& path : run.paths) {
    for (const auto& point : path) {
      if (!isGap(point)) include({point.x, point.x, point.y, point.y});
    }
  }
  return area;
}

}  // namespace robosim
