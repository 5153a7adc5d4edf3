#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "control/controller.h"
#include "control/known_world.h"
#include "control/parameters.h"

namespace robosim {

/// What distinguishes the controllers of a run.
struct ControllerSetup {
  std::uint64_t seed = 1;   ///< of the run
  std::uint32_t robot = 0;  ///< index in the world, so that robots draw different random numbers
  /// Start pose in the world frame [m, rad], as an operator would enter it; nullopt if unknown, as for a real robot.
  std::optional<mrpt::math::TPose2D> world_from_start = {};
  /// For a controller of a type with `knows_world`; null for others.
  std::shared_ptr<const KnownWorld> known_world = {};
};

/// A kind of controller.
struct ControllerType {
  using Setup = ControllerSetup;
  static constexpr const char* kKind = "controller";

  std::string name;               ///< in world files and on the command line; of letters, digits and '_'
  std::string help;               ///< one sentence
  std::vector<SensorKind> needs;  ///< required sensors
  std::vector<Parameter> parameters;
  std::function<std::unique_ptr<Controller>(const ControllerSetup&, const ParameterValues&)> make;
  bool knows_world = false;  ///< whether its setup must contain the start pose and ControllerSetup::known_world
};

}  // namespace robosim
