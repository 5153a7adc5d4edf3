#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "control/controller_type.h"

namespace robosim {

/// Known kinds of controllers. A choice is a text as of ControllerChoice: "wander", "flocking cohesion=0.3".
class ControllerRegistry {
 public:
  /// @throws ConfigError for an invalid or known name, a default value out of bounds, or a type without `make`
  void add(ControllerType type);

  std::span<const ControllerType> types() const { return types_; }
  std::vector<std::string> names() const;
  /// Finds the type of a choice. @throws ConfigError with the known names when there is none
  const ControllerType& typeOf(const std::string& choice) const;
  /// The type's default values, replaced by those of the choice.
  /// @throws ConfigError for an unknown controller, and a parameter that is unknown, given twice or out of bounds
  ControllerParameters parametersOf(const std::string& choice) const;
  std::unique_ptr<Controller> make(const std::string& choice, const ControllerSetup&) const;  ///< @throws ConfigError

 private:
  std::vector<ControllerType> types_;
};

}  // namespace robosim
