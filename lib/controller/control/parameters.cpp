#include "control/parameters.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "base/error_list.h"
#include "base/xml_element.h"

namespace robosim {
namespace {

const Parameter* parameterNamed(std::span<const Parameter> declared, const std::string& name) {
  const auto found =
      std::find_if(declared.begin(), declared.end(), [&](const Parameter& one) { return one.name == name; });
  return found == declared.end() ? nullptr : &*found;
}

std::string parametersText(std::span<const Parameter> declared) {
  if (declared.empty()) return "it has none";
  std::vector<std::string> names;
  for (const auto& parameter : declared) names.push_back(parameter.name);
  return "it has: " + listed(names);
}

double valueOf(const Parameter& parameter, const std::string& text, const std::string& of_type) {
  const auto value = parseNumber(text);
  if (value && std::isfinite(*value) && *value >= parameter.min && *value <= parameter.max) return *value;
  const std::string unit = parameter.unit.empty() ? "" : " " + parameter.unit;
  throw ConfigError(of_type + "parameter " + parameter.name + "=" + text +
                    (value ? " is out of bounds" : " is not a number") + "; use " + toText(parameter.min) + " to " +
                    toText(parameter.max) + unit + ", or drop it for the default, " + toText(parameter.default_value));
}

}  // namespace

double ParameterValues::operator[](const std::string& name) const {
  const auto found =
      std::find_if(values_.begin(), values_.end(), [&](const auto& value) { return value.first == name; });
  if (found == values_.end()) throw std::logic_error("the type declares no parameter '" + name + "'");
  return found->second;
}

bool isTypeName(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

void checkDeclared(std::span<const Parameter> declared, const std::string& of_type) {
  for (const auto& parameter : declared) {
    if (!isTypeName(parameter.name) || parameter.name == "name" ||
        parameterNamed(declared, parameter.name) != &parameter) {
      throw ConfigError(of_type + "'" + parameter.name + "' cannot be the name of a parameter");
    }
    const double value = parameter.default_value;
    if (!(std::isfinite(value) && value >= parameter.min && value <= parameter.max)) {
      throw ConfigError(of_type + "the default value of the parameter " + parameter.name + " is out of bounds");
    }
  }
}

ParameterValues valuesOf(std::span<const Parameter> declared, const TypeChoice& choice, const std::string& of_type) {
  const auto& given = choice.parameters;
  for (auto it = given.begin(); it != given.end(); ++it) {
    if (!parameterNamed(declared, it->first)) {
      throw ConfigError(of_type + "there is no parameter '" + it->first + "'; " + parametersText(declared));
    }
    if (std::any_of(given.begin(), it, [&](const auto& before) { return before.first == it->first; })) {
      throw ConfigError(of_type + "the parameter " + it->first + " is given twice; keep one");
    }
  }
  std::vector<std::pair<std::string, double>> values;
  for (const auto& parameter : declared) {
    const auto found =
        std::find_if(given.begin(), given.end(), [&](const auto& it) { return it.first == parameter.name; });
    values.emplace_back(parameter.name,
                        found == given.end() ? parameter.default_value : valueOf(parameter, found->second, of_type));
  }
  return ParameterValues(std::move(values));
}

}  // namespace robosim
