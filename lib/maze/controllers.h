#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "control/controller.h"

namespace robosim {

/// What a controller is made from besides its robot.
struct ControllerSetup {
  std::uint64_t seed = 1;   ///< of the run
  std::uint32_t robot = 0;  ///< its place in the world's list, so that robots draw different random numbers
};

struct ControllerType {
  const char* name;               ///< in world files and on the command line
  const char* help;               ///< one sentence
  std::vector<SensorKind> needs;  ///< sensors without which it cannot work
  std::unique_ptr<Controller> (*make)(const ControllerSetup&);
};

/// Every controller there is: gold_finder, wander, wall_follower, still.
std::span<const ControllerType> controllerTypes();
std::vector<std::string> controllerNames();

/// The type of that name. @throws ConfigError naming the known ones when there is none.
const ControllerType& controllerType(const std::string& name);

/// @throws ConfigError naming the known ones when there is no controller of that name.
std::unique_ptr<Controller> makeController(const std::string& name, const ControllerSetup&);

}  // namespace robosim
