#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "control/controller.h"

namespace robosim {

/// Arguments of a controller's factory.
struct ControllerSetup {
  std::uint64_t seed = 1;   ///< of the run
  std::uint32_t robot = 0;  ///< index in the world, so that robots draw different random numbers
};

struct ControllerType {
  const char* name;               ///< in world files and on the command line
  const char* help;               ///< one sentence
  std::vector<SensorKind> needs;  ///< required sensors
  std::unique_ptr<Controller> (*make)(const ControllerSetup&);
};

/// All controllers: gold_finder, wander, wall_follower, still.
std::span<const ControllerType> controllerTypes();
std::vector<std::string> controllerNames();

/// Finds a controller type by name. @throws ConfigError with the known names when there is none.
const ControllerType& controllerType(const std::string& name);

/// @throws ConfigError with the known names when there is no controller of that name.
std::unique_ptr<Controller> makeController(const std::string& name, const ControllerSetup&);

}  // namespace robosim
