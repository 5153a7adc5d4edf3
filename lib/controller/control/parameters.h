#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/type_choice.h"

namespace robosim {

/// A numeric parameter of a controller or an observer, which world files and the command line may set.
struct Parameter {
  std::string name;  ///< of letters, digits and '_', with its unit as suffix: "radius_m"; not "name"
  double default_value = 0;
  double min = 0, max = 0;  ///< both are valid values
  std::string unit;         ///< as printed: "m", "°C"; empty for a number without unit
  std::string help;         ///< a phrase: "distance at which neighbours attract"
};

/// Values of all parameters of a type.
class ParameterValues {
 public:
  explicit ParameterValues(std::vector<std::pair<std::string, double>> values = {}) : values_(std::move(values)) {}
  /// @throws std::logic_error for a name that the type does not declare
  double operator[](const std::string& name) const;

 private:
  std::vector<std::pair<std::string, double>> values_;
};

/// Whether a text consists of letters, digits and '_', as the names of types and parameters do.
bool isTypeName(const std::string& text);

/// Checks the declaration of parameters.
/// @param of_type begins errors: "controller 'flocking': "
/// @throws ConfigError for an invalid name, one that is declared twice, and a default value out of bounds
void checkDeclared(std::span<const Parameter> declared, const std::string& of_type);

/// The default values, replaced by those of a choice.
/// @throws ConfigError for a parameter that is unknown, given twice or out of bounds
ParameterValues valuesOf(std::span<const Parameter> declared, const TypeChoice& choice, const std::string& of_type);

}  // namespace robosim
