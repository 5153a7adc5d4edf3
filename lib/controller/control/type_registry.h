#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error_list.h"
#include "base/type_choice.h"
#include "control/parameters.h"

namespace robosim {

/// Known types of controllers or observers. A choice of one is a text as of TypeChoice: "wander",
/// "flocking cohesion=0.3".
/// @tparam Type ControllerType, ObserverType
template <typename Type>
class TypeRegistry {
 public:
  /// @throws ConfigError for an invalid or known name, a default value out of bounds, or a type without `make`
  void add(Type type) {
    const std::string of_type = ofType(type.name);
    if (!isTypeName(type.name)) throw ConfigError(of_type + "a name consists of letters, digits and '_'");
    if (find(type.name)) throw ConfigError(of_type + "there is one of this name already");
    if (!type.make) throw ConfigError(of_type + "its type has no function that makes it");
    checkDeclared(type.parameters, of_type);
    types_.push_back(std::move(type));
  }

  std::span<const Type> types() const { return types_; }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& type : types_) names.push_back(type.name);
    return names;
  }
  /// Finds the type of a choice. @throws ConfigError with the known names when there is none
  const Type& typeOf(const std::string& choice) const {
    const std::string name = TypeChoice::parse(choice, Type::kKind).name;
    if (const Type* type = find(name)) return *type;
    std::string known;
    for (const auto& type : types_) known += (known.empty() ? "" : ", ") + type.name;
    throw ConfigError("there is no " + std::string(Type::kKind) + " '" + name + "'; take one of " + known);
  }
  /// The type's default values, replaced by those of the choice.
  /// @throws ConfigError for an unknown type, and a parameter that is unknown, given twice or out of bounds
  ParameterValues parametersOf(const std::string& choice) const {
    const Type& type = typeOf(choice);
    return valuesOf(type.parameters, TypeChoice::parse(choice, Type::kKind), ofType(type.name));
  }
  /// Calls the type's `make` with a setup and the choice's values. @throws ConfigError
  auto make(const std::string& choice, const typename Type::Setup& setup) const {
    return typeOf(choice).make(setup, parametersOf(choice));
  }

 private:
  const Type* find(const std::string& name) const {
    for (const auto& type : types_) {
      if (type.name == name) return &type;
    }
    return nullptr;
  }
  static std::string ofType(const std::string& name) { return std::string(Type::kKind) + " '" + name + "': "; }

  std::vector<Type> types_;
};

}  // namespace robosim
