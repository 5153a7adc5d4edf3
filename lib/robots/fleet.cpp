#include "robots/fleet.h"

#include <algorithm>
#include <cmath>

#include <mrpt/math/wrap2pi.h>

#include "robots/model_shelf.h"
#include "robots/start_check.h"
#include "world/world_file.h"

namespace robosim {
namespace {

FleetRobot made(const RobotPlacement& placement, std::shared_ptr<const RobotModel> model) {
  FleetRobot robot;
  robot.info = {.name = placement.name,
                .model = model->name,
                .neighbour = placement.neighbour,
                .radius_m = model->radius_m,
                .height_m = model->body.height_m,
                .limits = model->limits,
                .sensors = model->sensor_infos};
  robot.world_from_start = placement.world_from_robot;
  robot.world_from_start.phi = mrpt::math::wrapToPi(robot.world_from_start.phi);
  robot.body = placement.body.value_or(model->body);
  if (placement.color) robot.body.color = *placement.color;
  robot.body.world_from_body = robot.world_from_start;
  robot.controller = placement.controller;
  robot.model = std::move(model);
  return robot;
}

}  // namespace

Fleet buildFleet(const World& world, const std::string& world_file, const RobotTypes& types,
                 const std::vector<std::string>& controllers, ErrorList& errors) {
  // Where a place or a size could not be read, something harmless stands, and whether that overlaps is no news.
  const bool places_are_known = errors.empty();
  ModelShelf shelf(world, world_file, types, errors);
  Fleet fleet;
  std::vector<RobotStart> starts;
  fleet.robots.reserve(world.robots.size());
  starts.reserve(world.robots.size());
  for (const auto& placement : world.robots) {
    if (!placement.controller.empty() && !controllers.empty() &&
        std::find(controllers.begin(), controllers.end(), placement.controller) == controllers.end()) {
      errors.add(world_file, placement.line.number,
                 "robot '" + placement.name + "': there is no controller '" + placement.controller +
                     "'; known are: " + listed(controllers));
    }
    auto model = shelf.modelFor(placement);
    if (!model) continue;
    fleet.robots.push_back(made(placement, std::move(model)));
    const FleetRobot& robot = fleet.robots.back();
    const Circle disc{{robot.world_from_start.x, robot.world_from_start.y}, robot.model->radius_m};
    starts.push_back({placement.name, placement.line.number, disc, robot.body.heights()});
  }
  if (places_are_known) checkStarts(world, starts, world_file, errors);
  return fleet;
}

LoadedWorld loadWorld(const std::filesystem::path& file, const std::vector<std::string>& controllers) {
  ErrorList errors;
  LoadedWorld loaded;
  loaded.world = readWorld(file, errors);
  loaded.fleet = buildFleet(loaded.world, file.string(), robotTypesIn(robotTypeFolders(file)), controllers, errors);
  errors.throwIfAny();
  return loaded;
}

}  // namespace robosim
