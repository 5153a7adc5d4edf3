#include "rendering/snapshot_run.h"

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

DrawnRun drawnRun(const Fleet& fleet, const RunSnapshot& snapshot, const RunPaths& paths, const TopViewLayers& layers) {
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
    if (robot.activity == Activity::found) run.events.push_back({RunEvent::Kind::gold, i, {pose->x, pose->y}});
    if (robot.stalled) run.events.push_back({RunEvent::Kind::stall, i, {pose->x, pose->y}});
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
  return run;
}

}  // namespace robosim
