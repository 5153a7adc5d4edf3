#include "learning/batch_world.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "base/error_list.h"

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

}  // namespace

BatchAgents listAgents(const LoadedWorld& world, const BatchOptions& options) {
  const auto& robots = world.fleet.robots;
  requireRobots(world, options);
  BatchAgents agents;
  const std::span team(robots.data(), options.agents == 0 ? robots.size() : options.agents);
  agents.layouts = ObservationLayout::ofTeam(team, options.observations);
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
