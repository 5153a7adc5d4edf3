#include "distributed/interaction.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "geometry/shapes/path.h"
#include "robots/drive_kinematics.h"

namespace robosim {
namespace {

constexpr double kSlack = 1 + 1e-6;  ///< exceeds all rounding errors

}  // namespace

Interaction Interaction::of(const World& world, const Fleet& fleet, double period_s) {
  Interaction interaction;
  if (world.communication.range_m || world.communication.hasWalls())
    interaction.unlimited_by = "messages depend on the positions of their senders and receivers";
  double sensor_m = 0, radius_max_m = 0, speed_max_mps = 0;
  for (const FleetRobot& robot : fleet.robots) {
    radius_max_m = std::max(radius_max_m, robot.info.radius_m);
    speed_max_mps = std::max(speed_max_mps, groundSpeedMax(robot.info.type->drive, robot.info.type->limits));
    if (robot.body().heat_celsius != 0) interaction.unlimited_by = "robot '" + robot.info.name + "' is hot";
  }
  std::unordered_set<const RobotModel*> models;
  for (const FleetRobot& robot : fleet.robots) {
    if (!models.insert(robot.model.get()).second) continue;
    for (const auto& sensor : robot.model->sensors) {
      const double reach_m = sensor->robotReach(speed_max_mps);  // robots of a model may differ in speed
      sensor_m = std::max(sensor_m, reach_m);
      if (!std::isfinite(reach_m))
        interaction.unlimited_by = "sensor '" + sensor->info().label + "' of robot '" + robot.info.name +
                                   "' may measure robots at any distance";
    }
  }
  interaction.step_m = speed_max_mps * period_s * kSlack;
  // A sensor meets the edge of another robot. A collision in a step is of robots that have moved towards each other
  // since its start, or of robots that would have.
  const double collision_m = 2 * radius_max_m + 2 * interaction.step_m + kContactGap_m;
  interaction.reach_m = std::max(sensor_m + radius_max_m, collision_m) * kSlack + kContactGap_m;
  return interaction;
}

}  // namespace robosim
