#include "rendering/snapshot_run.h"

#include <string_view>
#include <unordered_map>
#include <utility>

#include "rendering/free_areas.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kArcPiece_m = 0.05;  ///< of a sonar sector's arc

}  // namespace

DrawnPath drawnPath(std::size_t robot, const RunPaths& paths, double from_s, double to_s, bool is_present) {
  DrawnPath drawn;
  const auto add = [&](const TPoint2D& at, double time_s) {
    drawn.points.push_back(at);
    drawn.times_s.push_back(time_s);
  };
  const PathPart part = paths.between(robot, from_s, to_s);
  if (part.begin) add(*part.begin, from_s);
  for (const auto& point : part.points) {
    if (point.is_after_gap && !drawn.points.empty()) add(kPathGap, point.time_s);
    add(point.at, point.time_s);
  }
  // The vertices end before the place where a robot was last seen.
  if (const auto end = paths.positionAt(robot, to_s); end && !is_present && !drawn.points.empty()) add(*end, to_s);
  return drawn;
}

RunSnapshot onlyShown(RunSnapshot snapshot, const ViewLayers& layers) {
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    if (!layers.shows(i)) snapshot.robots[i].activity = Activity::absent;
  }
  return snapshot;
}

void addEvents(RunEvents& events, const Fleet& fleet, const RunSnapshot& snapshot) {
  const auto place_of = [&](std::size_t i) -> std::optional<TPoint2D> {
    const RobotSnapshot& robot = snapshot.robots[i];
    if (!robot.isPresent()) return std::nullopt;
    return TPoint2D(robot.world_from_robot.x, robot.world_from_robot.y);
  };
  std::unordered_map<std::string_view, std::size_t> index_of;  // of the names, if there is a message
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    const RobotSnapshot& robot = snapshot.robots[i];
    const std::string& name = fleet.robots[i].info.name;
    const bool has_found = robot.activity == Activity::found || (robot.readings && robot.readings->winner == name);
    events.addState(i, robot.stalled, has_found, place_of(i), snapshot.time_s);
    if (!robot.readings || robot.readings->inbox.empty()) continue;
    if (index_of.empty()) {
      for (std::size_t k = 0; k < snapshot.robots.size(); ++k) index_of.emplace(fleet.robots[k].info.name, k);
    }
    for (const auto& message : robot.readings->inbox) {
      const auto sender = index_of.find(message.from);
      if (sender != index_of.end()) events.addMessage(sender->second, place_of(sender->second), snapshot.time_s);
    }
  }
}

DrawnRun drawnRun(const Fleet& fleet, const RunSnapshot& snapshot, const RunPaths& paths, const ViewLayers& layers,
                  const RunEvents* events) {
  DrawnRun run;
  run.has_names = layers.names;
  run.has_starts = layers.starts;
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    const RobotSnapshot& robot = snapshot.robots[i];
    if (layers.paths && paths.robots() > 0) {
      DrawnPath path;
      if (layers.shows(i)) path = drawnPath(i, paths, layers.paths_from_s, snapshot.time_s, robot.isPresent());
      run.paths.push_back(std::move(path.points));
      run.path_times_s.push_back(std::move(path.times_s));
    }
    auto& pose = run.world_from_robot.emplace_back();
    if (!robot.isPresent() || !layers.shows(i)) continue;
    pose = robot.world_from_robot;
  }
  RunEvents of_snapshot;
  if (!events) addEvents(of_snapshot, fleet, snapshot);
  for (const auto& [time_s, event] : (events ? *events : of_snapshot).all()) {
    if (!layers.events || !layers.shows(event.robot)) continue;
    if (time_s >= layers.paths_from_s && time_s <= snapshot.time_s) run.events.push_back(event);
  }
  if (!layers.sensors) return run;
  const auto is_shown = [&](const RobotSnapshot& robot) {
    return layers.shows(static_cast<std::size_t>(&robot - snapshot.robots.data()));
  };
  forEachEchoes(fleet, snapshot, [&](const RobotSnapshot& robot, const SensorInfo& sensor, const Echoes& echoes) {
    if (!is_shown(robot)) return;
    SensedArea& sensed = run.sensed.emplace_back(SensedArea{sensor.kind});
    sensed.free = freeAreas(robot, sensor, echoes, kArcPiece_m);
    for (const auto& echo : echoes) {
      if (echo.range_m >= sensor.range_max_m) continue;
      sensed.echoes.push_back(robot.world_from_robot.composePoint(TPoint2D(echo.point_m.x, echo.point_m.y)));
    }
  });
  forEachSightLines(fleet, snapshot, [&](const RobotSnapshot& robot, const SensorInfo& sensor, const auto& lines) {
    if (is_shown(robot)) run.sensed.push_back({.kind = sensor.kind, .lines = lines});
  });
  return run;
}

}  // namespace robosim
