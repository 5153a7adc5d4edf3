#pragma once
#include <cstdint>
#include <memory>
#include <utility>

#include "geometry/scene.h"
#include "robots/fleet.h"
#include "world/robot_additions.h"
#include "world/world.h"

namespace robosim {

/// All that is constant during a run and determines it together with the commands: the world, its robots with their
/// limits and sensor options, and the run's parameters. A run is a Model and a State. When an intervention adds a
/// robot, the run continues with another Model, of the same World (withAdditions()).
struct Model {
  Model(World the_world, Fleet the_fleet, std::uint64_t the_seed = 1, double the_period_s = 0.1)
      : shared_world(std::make_shared<const World>(std::move(the_world))),
        world(*shared_world),
        stationary(indexStationary(stationarySolids(world.objects, world.maps), world.bounds)),
        fleet(std::move(the_fleet)),
        seed(the_seed),
        period_s(the_period_s) {}

  std::shared_ptr<const World> shared_world;
  const World& world;  ///< the shared one
  /// Of the world's objects and maps: all runs in which no intervention has changed an object share it.
  std::shared_ptr<const GridIndex> stationary;
  Fleet fleet;
  RobotAdditions additions = {};  ///< the last robots of the fleet
  std::uint64_t seed = 1;
  double period_s = 0.1;  ///< length of a time step, (0, 1]
};

/// The model of the same run in which other robots have been added.
/// @throws ConfigError for a robot of an unknown or faulty type, and beyond the limits of a fleet
std::shared_ptr<const Model> withAdditions(const Model&, const RobotAdditions&);

/// Hash that identifies a model: equal for models that behave equally, also in different processes. It covers seed and
/// time step, solids, heat and colours, communication, win distance, and the robots' names, bodies, limits, starts and
/// sensors with their options.
std::uint64_t digestOf(const Model&);
/// The same of the model with which a run began, without the robots added since.
std::uint64_t digestOfStart(const Model&);
/// Hash of a robot, as in these.
std::uint64_t digestOf(const FleetRobot&);

}  // namespace robosim
