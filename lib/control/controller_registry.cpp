#include "control/controller_registry.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "base/controller_choice.h"
#include "base/error_list.h"
#include "base/xml_element.h"

namespace robosim {
namespace {

bool isName(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

const ControllerParameter* parameterOf(const ControllerType& type, const std::string& name) {
  const auto found = std::find_if(type.parameters.begin(), type.parameters.end(),
                                  [&](const ControllerParameter& parameter) { return parameter.name == name; });
  return found == type.parameters.end() ? nullptr : &*found;
}

std::string parametersText(const ControllerType& type) {
  if (type.parameters.empty()) return "it has none";
  std::vector<std::string> names;
  for (const auto& parameter : type.parameters) names.push_back(parameter.name);
  return "it has: " + listed(names);
}

double valueOf(const ControllerParameter& parameter, const std::string& text, const std::string& of_type) {
  const auto value = parseNumber(text);
  if (value && std::isfinite(*value) && *value >= parameter.min && *value <= parameter.max) return *value;
  const std::string unit = parameter.unit.empty() ? "" : " " + parameter.unit;
  throw ConfigError(of_type + "parameter " + parameter.name + "=" + text +
                    (value ? " is out of bounds" : " is not a number") + "; use " + toText(parameter.min) + " to " +
                    toText(parameter.max) + unit + ", or drop it for the default, " + toText(parameter.default_value));
}

}  // namespace

double ControllerParameters::operator[](const std::string& name) const {
  const auto found =
      std::find_if(values_.begin(), values_.end(), [&](const auto& value) { return value.first == name; });
  if (found == values_.end()) throw std::logic_error("the controller declares no parameter '" + name + "'");
  return found->second;
}

void ControllerRegistry::add(ControllerType type) {
  const std::string of_type = "controller '" + type.name + "': ";
  if (!isName(type.name)) throw ConfigError(of_type + "a name consists of letters, digits and '_'");
  for (const auto& known : types_) {
    if (known.name == type.name) throw ConfigError(of_type + "there is one of this name already");
  }
  if (!type.make) throw ConfigError(of_type + "its type has no function that makes it");
  for (const auto& parameter : type.parameters) {
    if (!isName(parameter.name) || parameter.name == "name" || parameterOf(type, parameter.name) != &parameter) {
      throw ConfigError(of_type + "'" + parameter.name + "' cannot be the name of a parameter");
    }
    const double value = parameter.default_value;
    if (!(std::isfinite(value) && value >= parameter.min && value <= parameter.max)) {
      throw ConfigError(of_type + "the default value of the parameter " + parameter.name + " is out of bounds");
    }
  }
  types_.push_back(std::move(type));
}

std::vector<std::string> ControllerRegistry::names() const {
  std::vector<std::string> names;
  for (const auto& type : types_) names.push_back(type.name);
  return names;
}

const ControllerType& ControllerRegistry::typeOf(const std::string& choice) const {
  const std::string name = ControllerChoice::parse(choice).name;
  const auto found =
      std::find_if(types_.begin(), types_.end(), [&](const ControllerType& type) { return type.name == name; });
  if (found != types_.end()) return *found;
  std::string known;
  for (const auto& type : types_) known += (known.empty() ? "" : ", ") + type.name;
  throw ConfigError("there is no controller '" + name + "'; take one of " + known);
}

ControllerParameters ControllerRegistry::parametersOf(const std::string& choice) const {
  const ControllerType& type = typeOf(choice);
  const auto given = ControllerChoice::parse(choice).parameters;
  const std::string of_type = "controller '" + type.name + "': ";
  for (auto it = given.begin(); it != given.end(); ++it) {
    if (!parameterOf(type, it->first)) {
      throw ConfigError(of_type + "there is no parameter '" + it->first + "'; " + parametersText(type));
    }
    if (std::any_of(given.begin(), it, [&](const auto& before) { return before.first == it->first; })) {
      throw ConfigError(of_type + "the parameter " + it->first + " is given twice; keep one");
    }
  }
  std::vector<std::pair<std::string, double>> values;
  for (const auto& parameter : type.parameters) {
    const auto found =
        std::find_if(given.begin(), given.end(), [&](const auto& it) { return it.first == parameter.name; });
    values.emplace_back(parameter.name,
                        found == given.end() ? parameter.default_value : valueOf(parameter, found->second, of_type));
  }
  return ControllerParameters(std::move(values));
}

std::unique_ptr<Controller> ControllerRegistry::make(const std::string& choice, const ControllerSetup& setup) const {
  return typeOf(choice).make(setup, parametersOf(choice));
}

}  // namespace robosim
