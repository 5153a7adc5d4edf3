#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error_list.h"
#include "robots/robot_model.h"
#include "robots/robot_types.h"
#include "world/world.h"

namespace robosim {

/// A robot of a world, ready to run.
struct FleetRobot {
  RobotInfo info;
  std::shared_ptr<const RobotModel> model;
  mrpt::math::TPose2D world_from_start;
  Body body;               ///< at the start; sensors of others see this shape
  std::string controller;  ///< empty: the program's default
};

/// The robots of a world, in the world's order.
struct Fleet {
  std::vector<FleetRobot> robots;
};

/// Makes each placed robot's model, and checks the start: adds to `errors` every unknown model, wrong sensor, unknown
/// controller (not in `controllers`; an empty list accepts all), robot outside the bounds, and robot that overlaps
/// an object or another robot. `world_file` names the file in errors.
Fleet buildFleet(const World&, const std::string& world_file, const RobotTypes& types,
                 const std::vector<std::string>& controllers, ErrorList& errors);

/// A world and its robots.
struct LoadedWorld {
  World world;
  Fleet fleet;
};

/// Reads a world file and builds its fleet.
/// @throws ConfigError with every fault found.
LoadedWorld loadWorld(const std::filesystem::path& file, const std::vector<std::string>& controllers);

}  // namespace robosim
