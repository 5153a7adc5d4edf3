#include "rendering/body_picking.h"

#include <algorithm>
#include <limits>

namespace robosim {
namespace {

constexpr double kRobotRadiusMin_px = 6;

Body robotBody(const FleetRobot& robot, const RobotSnapshot& snapshot) {
  Body body = robot.body();
  body.shape = Cylinder{robot.info.radius_m};
  body.world_from_body = snapshot.world_from_robot;
  return body;
}

PickedBody pickedRobot(const FleetRobot& robot, const RobotSnapshot& snapshot) {
  return {robot.info.name, true, robotBody(robot, snapshot)};
}
PickedBody pickedObject(const WorldObject& object) { return {object.name, false, object.body}; }

/// Keeps the nearest hit.
struct Nearest {
  Ray sight;
  double distance_m = std::numeric_limits<double>::infinity();

  bool isHit(const Solid& solid) {
    const auto hit_m = intersect(sight, solid);
    if (!hit_m || *hit_m >= distance_m) return false;
    distance_m = *hit_m;
    return true;
  }
};

}  // namespace

std::optional<PickedBody> pickBody(const PaneProjection& pane, const mrpt::math::TPoint2D& pixel,
                                   const RunSnapshot& snapshot, const LoadedWorld& world) {
  const double radius_min_m = kRobotRadiusMin_px * pane.metresPerPixel();
  std::optional<PickedBody> picked;
  Nearest nearest{pane.sightThrough(pixel)};
  const auto& robots = world.fleet.robots;
  for (std::size_t i = 0; i < std::min(robots.size(), snapshot.robots.size()); ++i) {
    if (!snapshot.robots[i].isPresent()) continue;
    Body body = robotBody(robots[i], snapshot.robots[i]);
    body.shape = Cylinder{std::max(robots[i].info.radius_m, radius_min_m)};
    if (nearest.isHit(body.solid())) picked = pickedRobot(robots[i], snapshot.robots[i]);
  }
  if (!picked || !pane.isFromAbove()) {
    for (const WorldObject& object : snapshot.objects.orThose(world.world.objects)) {
      if (nearest.isHit(object.body.solid())) picked = pickedObject(object);
    }
  }
  if (picked) picked->at_z_m = nearest.sight.at(nearest.distance_m).z;
  return picked;
}

std::optional<PickedBody> bodyNamed(const std::string& name, const RunSnapshot& snapshot, const LoadedWorld& world) {
  const auto& robots = world.fleet.robots;
  for (std::size_t i = 0; i < std::min(robots.size(), snapshot.robots.size()); ++i) {
    if (robots[i].info.name == name && snapshot.robots[i].isPresent())
      return pickedRobot(robots[i], snapshot.robots[i]);
  }
  for (const WorldObject& object : snapshot.objects.orThose(world.world.objects)) {
    if (object.name == name) return pickedObject(object);
  }
  return std::nullopt;
}

}  // namespace robosim
