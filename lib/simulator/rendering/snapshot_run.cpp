#include "rendering/snapshot_run.h"

#include <string_view>
#include <unordered_map>

#include "rendering/free_areas.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kArcPiece_m = 0.05;  ///< of a sonar sector's arc

/// The drawn part of a robot's path, without its end at a present robot.
std::vector<TPoint2D> pathOf(std::size_t robot, const RunPaths& paths, double from_s, double to_s, bool is_present) {
  std::vector<TPoint2D> drawn;
  const PathPart part = paths.between(robot, from_s, to_s);
  if (part.begin) drawn.push_back(*part.begin);
  for (const auto& point : part.points) {
    if (point.is_after_gap && !drawn.empty()) drawn.push_back(kPathGap);
    drawn.push_back(point.at);
  }
  // The vertices end before the place where a robot was last seen.
  if (const auto end = paths.positionAt(robot, to_s); end && !is_present && !drawn.empty()) drawn.push_back(*end);
  return drawn;
}

}  // namespace

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

DrawnRun drawnRun(const Fleet& fleet, const RunSnapshot& snapshot, const RunPaths& paths, const TopViewLayers& layers,
                  const RunEvents* events) {
  DrawnRun run;
  run.has_names = layers.names;
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    const RobotSnapshot& robot = snapshot.robots[i];
    if (layers.paths && paths.robots() > 0) {
      run.paths.push_back(pathOf(i, paths, layers.paths_from_s, snapshot.time_s, robot.isPresent()));
    }
    auto& pose = run.world_from_robot.emplace_back();
    if (!robot.isPresent()) continue;
    pose = robot.world_from_robot;
  }
  RunEvents of_snapshot;
  if (!events) addEvents(of_snapshot, fleet, snapshot);
  for (const auto& [time_s, event] : (events ? *events : of_snapshot).all()) {
    if (layers.events && time_s >= layers.paths_from_s && time_s <= snapshot.time_s) run.events.push_back(event);
  }
  if (!layers.sensors) return run;
  forEachEchoes(fleet, snapshot, [&](const RobotSnapshot& robot, const SensorInfo& sensor, const Echoes& echoes) {
    SensedArea& sensed = run.sensed.emplace_back(SensedArea{sensor.kind});
    sensed.free = freeAreas(robot, sensor, echoes, kArcPiece_m);
    for (const auto& echo : echoes) {
      if (echo.range_m >= sensor.range_max_m) continue;
      sensed.echoes.push_back(robot.world_from_robot.composePoint(TPoint2D(echo.point_m.x, echo.point_m.y)));
    }
  });
  forEachSightLines(fleet, snapshot, [&](const RobotSnapshot&, const SensorInfo& sensor, const auto& lines) {
    run.sensed.push_back({.kind = sensor.kind, .lines = lines});
  });
  return run;
}

}  // namespace robosim
