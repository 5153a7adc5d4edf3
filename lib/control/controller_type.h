#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "control/controller.h"

namespace robosim {

/// A numeric parameter of a controller, which world files and the command line may set.
struct ControllerParameter {
  std::string name;  ///< of letters, digits and '_', with its unit as suffix: "radius_m"; not "name"
  double default_value = 0;
  double min = 0, max = 0;  ///< both are valid values
  std::string unit;         ///< as printed: "m", "°C"; empty for a number without unit
  std::string help;         ///< a phrase: "distance at which neighbours attract"
};

/// Values of all parameters of a controller.
class ControllerParameters {
 public:
  explicit ControllerParameters(std::vector<std::pair<std::string, double>> values = {}) : values_(std::move(values)) {}
  /// @throws std::logic_error for a name that the controller's type does not declare
  double operator[](const std::string& name) const;

 private:
  std::vector<std::pair<std::string, double>> values_;
};

/// What distinguishes the controllers of a run.
struct ControllerSetup {
  std::uint64_t seed = 1;   ///< of the run
  std::uint32_t robot = 0;  ///< index in the world, so that robots draw different random numbers
};

/// A kind of controller.
struct ControllerType {
  std::string name;               ///< in world files and on the command line; of letters, digits and '_'
  std::string help;               ///< one sentence
  std::vector<SensorKind> needs;  ///< required sensors
  std::vector<ControllerParameter> parameters;
  std::function<std::unique_ptr<Controller>(const ControllerSetup&, const ControllerParameters&)> make;
};

}  // namespace robosim
