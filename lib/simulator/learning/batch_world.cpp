#include "learning/batch_world.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "base/error_list.h"
#include "hardware/measurement_fields.h"

namespace robosim {
namespace {

std::string titleOf(const LoadedWorld& world) { return "world '" + world.world.name + "'"; }

int findHeatSlot(const RobotInfo& robot) {
  for (std::size_t slot = 0; slot < robot.sensors->size(); ++slot) {
    if ((*robot.sensors)[slot].kind == SensorKind::heat) return static_cast<int>(slot);
  }
  return -1;
}

void requireRobots(const LoadedWorld& world, const BatchOptions& options) {
  const std::size_t robots = world.fleet.robots.size();
  if (robots == 0) throw ConfigError(titleOf(world) + " has no robots; add at least one");
  if (options.agents > robots) {
    throw ConfigError(titleOf(world) + " has " + std::to_string(robots) + " robots, but " +
                      std::to_string(options.agents) + " agents are required; use fewer agents");
  }
}

/// Learning environments take no pictures that may differ between machines.
void refusePictures(const FleetRobot& robot, const ObservationLayout& layout) {
  for (const ObservationPart& part : layout.parts()) {
    if (part.slot >= robot.info.sensors->size()) continue;
    const SensorInfo& sensor = (*robot.info.sensors)[part.slot];
    if (sensor.camera.isRaycast()) continue;
    const Measurement blank = blankMeasurement(sensor);
    if (std::visit([]<typename M>(const M&) { return kIsReproducible<M>; }, blank)) continue;
    throw ConfigError("robot '" + robot.info.name + "' cannot observe '" + part.name +
                      "' in a learning environment, which takes no pictures of the model opengl; use <camera "
                      "model=\"raycast\">, or Simulation.readings()");
  }
}

std::vector<ObservedPicture> picturesOf(std::span<const FleetRobot> team,
                                        const std::vector<ObservationLayout>& layouts) {
  std::vector<ObservedPicture> pictures;
  for (std::size_t agent = 0; agent < layouts.size(); ++agent) {
    for (const ObservationPart& part : layouts[agent].parts()) {
      if (!part.picture) continue;
      auto found = std::find_if(pictures.begin(), pictures.end(), [&](const auto& of) { return of.name == part.name; });
      if (found == pictures.end()) {
        const std::vector<std::size_t> none(layouts.size(), ObservedPicture::kNone);
        found = pictures.insert(found, {part.name, *part.picture, part.range_max_m, none});
      }
      const CameraInfo &first = found->camera, &other = *part.picture;
      if (first.width_px != other.width_px || first.height_px != other.height_px || first.layers != other.layers ||
          found->range_max_m != part.range_max_m) {
        throw ConfigError("robot '" + team[agent].info.name + "': its pictures of '" + part.name +
                          "' differ in size, layers or range from those of another agent; give them equal cameras");
      }
      found->slots[agent] = part.slot;
    }
  }
  return pictures;
}

}  // namespace

BatchAgents listAgents(const LoadedWorld& world, const BatchOptions& options) {
  const auto& robots = world.fleet.robots;
  requireRobots(world, options);
  BatchAgents agents;
  const std::span team(robots.data(), options.agents == 0 ? robots.size() : options.agents);
  agents.layouts = ObservationLayout::ofTeam(team, options.observations);
  for (std::size_t i = 0; i < team.size(); ++i) refusePictures(team[i], agents.layouts[i]);
  agents.pictures = picturesOf(team, agents.layouts);
  for (const auto& layout : agents.layouts) agents.size = std::max(agents.size, layout.size());
  return agents;
}

std::shared_ptr<const BatchWorld> makeBatchWorld(LoadedWorld loaded, const BatchOptions& options,
                                                 const BatchAgents& agents) {
  requireRobots(loaded, options);
  const std::string title = titleOf(loaded);
  const std::size_t robots = loaded.fleet.robots.size();
  if (options.agents == 0 && robots != agents.count()) {
    throw ConfigError(title + " has " + std::to_string(robots) + " robots, but the first world has " +
                      std::to_string(agents.count()) + "; give the number of agents, or worlds with equal teams");
  }
  auto world = std::make_shared<BatchWorld>();
  for (std::size_t i = 0; i < agents.count(); ++i) {
    const FleetRobot& robot = loaded.fleet.robots[i];
    world->heat_slots.push_back(findHeatSlot(robot.info));
    if (ObservationLayout::ofPresent(robot.info, options.observations).isCompatible(agents.layouts[i])) continue;
    throw ConfigError(title + ": robot '" + robot.info.name + "' observes other numbers than agent " +
                      std::to_string(i + 1) +
                      " of the first world, or by other sensors; use the same robot types in all worlds");
  }
  if (options.start_distance_m) loaded.world.start_distance_m = options.start_distance_m;
  if (options.has_random_starts) world->random_starts.emplace(loaded.world, loaded.fleet);
  world->model =
      std::make_shared<const Model>(std::move(loaded.world), std::move(loaded.fleet), options.seed, options.period_s);
  world->start = initialState(*world->model);
  if (!options.has_digests) world->start.digest.reset();
  return world;
}

}  // namespace robosim
