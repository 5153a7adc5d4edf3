#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "control/controller.h"
#include "control/parameters.h"

namespace robosim {

/// What distinguishes the controllers of a run.
struct ControllerSetup {
  std::uint64_t seed = 1;   ///< of the run
  std::uint32_t robot = 0;  ///< index in the world, so that robots draw different random numbers
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
};

}  // namespace robosim
