#include "robots/fleet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include <mrpt/math/wrap2pi.h>

#include "base/log.h"
#include "robots/ray_budget.h"
#include "robots/robot_colors.h"
#include "robots/robot_model_cache.h"
#include "robots/scatter.h"
#include "robots/start_check.h"
#include "robots/start_places.h"
#include "robots/timeline_check.h"
#include "robots/world_source.h"
#include "world/world_file.h"

namespace robosim {
namespace {

/// Checks each controller once, since many robots have the same.
class ControllerFaults {
 public:
  explicit ControllerFaults(const ControllerCheck& check) : check_(check) {}
  /// @return what is wrong with a controller; empty for a valid one
  const std::string& of(const std::string& controller) {
    auto [checked, is_new] = faults_.try_emplace(controller);
    if (is_new && check_ && !controller.empty()) {
      try {
        check_(controller);
      } catch (const ConfigError& error) {
        checked->second = error.what();
      }
    }
    return checked->second;
  }

 private:
  const ControllerCheck& check_;
  std::unordered_map<std::string, std::string> faults_;
};

/// Adds a robot, which shares the name of its controller with the one before.
void add(FleetRobot robot, std::vector<FleetRobot>& robots) {
  if (!robots.empty() && robot.controller == robots.back().controller) robot.controller = robots.back().controller;
  robots.push_back(std::move(robot));
}

RobotStart startOf(const RobotPlacement& placement, const FleetRobot& robot) {
  const Circle disc{{robot.world_from_start.x, robot.world_from_start.y}, robot.model->radius_m};
  const Body body = robot.body();
  return {placement.name, placement.line, disc, body.heights(), body.solid().outline};
}

}  // namespace

Body FleetRobot::body() const {
  Body body = own_body ? *own_body : model ? model->body : Body();
  body.color = color;
  body.world_from_body = world_from_start;
  return body;
}

FleetRobot placedRobot(const RobotPlacement& placement, std::shared_ptr<const RobotModel> model) {
  FleetRobot robot;
  robot.info = {.name = placement.name,
                .type = model->type,
                .neighbour = placement.neighbour,
                .radius_m = model->radius_m,
                .height_m = model->body.height_m,
                .sensors = model->sensor_infos};
  robot.world_from_start = placement.world_from_robot;
  robot.world_from_start.phi = mrpt::math::wrapToPi(robot.world_from_start.phi);
  robot.own_body = placement.body;
  robot.color = placement.color.value_or(placement.body ? placement.body->color : model->body.color);
  robot.controller = placement.controller;
  robot.model = std::move(model);
  return robot;
}

Fleet buildFleet(const World& world, const std::string& world_file, const RobotTypes& types,
                 const ControllerCheck& check_controller, ErrorList& errors) {
  // After earlier errors, placeholder poses and sizes may be in use, so overlaps are not checked.
  const bool are_poses_valid = errors.empty();
  RobotModelCache models(world, world_file, types, errors);
  ControllerFaults faults_of_controllers(check_controller);
  RayBudget budget;
  Fleet fleet;
  std::vector<RobotStart> starts;
  fleet.robots.reserve(world.robots.size());
  starts.reserve(world.robots.size());
  for (const auto& placement : world.robots) {
    if (const std::string fault = faults_of_controllers.of(placement.controller); !fault.empty()) {
      errors.add(world.fileOf(placement.controller_line, world_file), placement.controller_line.number,
                 "robot '" + placement.name + "': " + fault);
    }
    auto model = models.modelFor(placement);
    if (!model) continue;
    if (const std::string excess = budget.add(model); !excess.empty()) {
      errors.add(world.fileOf(placement.line, world_file), placement.line.number,
                 "robot '" + placement.name + "': with it " + excess);
      break;
    }
    add(placedRobot(placement, std::move(model)), fleet.robots);
    starts.push_back(startOf(placement, fleet.robots.back()));
  }
  const bool has_all = fleet.robots.size() == world.robots.size();
  for (const TimedChange& timed : world.timeline) {
    const auto* added = std::get_if<AddRobot>(&timed.change);
    if (!added || !has_all) continue;
    if (const std::string fault = faults_of_controllers.of(added->controller); !fault.empty()) {
      errors.add(world.fileOf(timed.line, world_file), timed.line.number, "robot '" + added->name + "': " + fault);
    }
    RobotPlacement placement;
    placement.name = added->name;
    placement.model = added->model;
    placement.line = timed.line;
    models.modelFor(placement);
  }
  fleet.known_types = std::make_shared<const KnownTypes>(KnownTypes{types, world_file, models.modelsOfTypes()});
  if (has_all) setRobotColors(world, fleet);
  if (!are_poses_valid) return fleet;
  checkStarts(world, starts, world_file, errors);
  checkMovableObjects(world, world_file, errors);
  return fleet;
}

FleetRobot robotOfType(const RobotTypes& types, const std::string& model) {
  World alone;
  alone.bounds = {-1e6, 1e6, -1e6, 1e6};
  RobotPlacement placement;
  placement.name = "robot";
  placement.model = model;
  alone.robots.push_back(placement);
  ErrorList errors;
  Fleet fleet = buildFleet(alone, "robot type " + model, types, {}, errors);
  errors.throwIfAny();
  return fleet.robots.front();
}

Fleet buildFleet(const World& world, const std::string& world_file, const Fleet& alike, ErrorList& errors) {
  if (world.robots.size() != alike.robots.size()) {
    throw std::invalid_argument("a world of " + std::to_string(world.robots.size()) +
                                " robots cannot have the models of " + std::to_string(alike.robots.size()));
  }
  Fleet fleet;
  fleet.known_types = alike.known_types;
  std::vector<RobotStart> starts;
  fleet.robots.reserve(world.robots.size());
  starts.reserve(world.robots.size());
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    add(placedRobot(world.robots[i], alike.robots[i].model), fleet.robots);
    starts.push_back(startOf(world.robots[i], fleet.robots.back()));
  }
  setRobotColors(world, fleet);
  checkStarts(world, starts, world_file, errors);
  checkMovableObjects(world, world_file, errors);
  return fleet;
}

bool hasOtherDrives(const Fleet& fleet) {
  return std::any_of(fleet.robots.begin(), fleet.robots.end(),
                     [](const FleetRobot& robot) { return robot.info.type->drive.kind != DriveKind::differential; });
}

bool hasCamera(const Fleet& fleet) {
  return std::any_of(fleet.robots.begin(), fleet.robots.end(), [](const FleetRobot& robot) {
    const auto& sensors = *robot.info.sensors;
    return std::any_of(sensors.begin(), sensors.end(),
                       [](const SensorInfo& s) { return s.kind == SensorKind::camera; });
  });
}

bool needsImageSource(const RobotInfo& robot) {
  return std::any_of(robot.sensors->begin(), robot.sensors->end(), [](const SensorInfo& sensor) {
    return sensor.kind == SensorKind::camera && !sensor.camera.isRaycast();
  });
}

bool needsImageSource(const Fleet& fleet) {
  return std::any_of(fleet.robots.begin(), fleet.robots.end(),
                     [](const FleetRobot& robot) { return needsImageSource(robot.info); });
}

LoadedWorld placedWorld(World world, const std::string& world_file, const RobotTypes& types,
                        const ControllerCheck& check_controller, std::uint64_t seed, ErrorList& errors,
                        std::vector<std::string>* warnings) {
  LoadedWorld placed{std::move(world), {}};
  placeScattered(placed.world, world_file, types, seed, errors);
  checkTimeline(placed.world, world_file, errors);
  const ErrorList before = errors;
  placed.fleet = buildFleet(placed.world, world_file, types, check_controller, errors);
  const bool has_models = placed.fleet.robots.size() == placed.world.robots.size();
  if (errors.empty() || !before.empty() || !has_models || !hasRobotsAtMapStarts(placed.world)) return placed;
  errors = before;
  const auto moved = moveFromBlockedStarts(placed.world, world_file, types, errors);
  if (warnings) *warnings = moved;
  for (const auto& warning : moved) {
    if (!warnings) logWarning("", warning);
  }
  placed.fleet = buildFleet(placed.world, world_file, types, check_controller, errors);
  return placed;
}

LoadedWorld loadWorld(const std::filesystem::path& file, const ControllerCheck& check_controller, std::uint64_t seed) {
  if (isStageFile(file)) {
    WorldSource source = readWorldSource(file);
    source.seed = seed;
    return loadWorld(source, check_controller);
  }
  ErrorList errors;
  World world = readWorld(file, errors);
  const RobotTypes types = robotTypesIn(robotTypeFolders(file));
  LoadedWorld loaded = placedWorld(std::move(world), file.string(), types, check_controller, seed, errors);
  errors.throwIfAny();
  return loaded;
}

}  // namespace robosim
