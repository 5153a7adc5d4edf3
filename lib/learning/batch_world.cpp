#include "learning/batch_world.h"

#include <string>
#include <utility>

#include "base/error_list.h"

namespace robosim {
namespace {

std::string titleOf(const LoadedWorld& world) { return "world '" + world.world.name + "'"; }

int heatSlotOf(const RobotInfo& robot) {
  for (std::size_t slot = 0; slot < robot.sensors->size(); ++slot) {
    if ((*robot.sensors)[slot].kind == SensorKind::heat) return static_cast<int>(slot);
  }
  return -1;
}

}  // namespace

BatchAgents agentsOf(const LoadedWorld& world, const BatchOptions& options) {
  const auto& robots = world.fleet.robots;
  if (robots.empty()) throw ConfigError(titleOf(world) + " has no robots; add at least one");
  return {options.agents == 0 ? robots.size() : options.agents,
          ObservationLayout(robots.front().info, options.observations)};
}

std::shared_ptr<const BatchWorld> makeBatchWorld(LoadedWorld loaded, const BatchOptions& options,
                                                 const BatchAgents& agents) {
  const std::string title = titleOf(loaded);
  const std::size_t robots = loaded.fleet.robots.size();
  if (robots == 0) throw ConfigError(title + " has no robots; add at least one");
  if (options.agents > robots) {
    throw ConfigError(title + " has " + std::to_string(robots) + " robots, but " + std::to_string(options.agents) +
                      " agents are required; use fewer agents");
  }
  if (options.agents == 0 && robots != agents.count) {
    throw ConfigError(title + " has " + std::to_string(robots) + " robots, but the first world has " +
                      std::to_string(agents.count) + "; give the number of agents, or worlds with equal teams");
  }
  auto world = std::make_shared<BatchWorld>();
  const RobotModel* checked = nullptr;
  for (std::size_t i = 0; i < agents.count; ++i) {
    const FleetRobot& robot = loaded.fleet.robots[i];
    world->heat_slots.push_back(heatSlotOf(robot.info));
    if (robot.model.get() == checked) continue;
    checked = robot.model.get();
    if (ObservationLayout(robot.info, options.observations).isCompatible(agents.layout)) continue;
    throw ConfigError(
        title + ": robot '" + robot.info.name +
        "' observes other numbers than the first agent, or by other sensors; use agents of one robot type");
  }
  if (options.start_distance_m) loaded.world.start_distance_m = options.start_distance_m;
  if (options.has_random_starts) world->random_starts.emplace(loaded.world, loaded.fleet);
  world->model = std::make_shared<const Model>(
      Model{std::move(loaded.world), std::move(loaded.fleet), options.seed, options.period_s});
  world->start = initialState(*world->model);
  if (!options.has_digests) world->start.digest.reset();
  return world;
}

}  // namespace robosim
