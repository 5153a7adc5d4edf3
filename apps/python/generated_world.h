#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "learning/world_generator.h"
#include "python_world.h"
#include "whole_number.h"

namespace robosim {

/// Robot types of generated worlds unless others are given.
inline const std::vector<std::string> kGeneratedTypes{"pioneer3dx"};

/// Python's class WorldGenerator: random worlds (world/generation/generators.h) that differ in their seed only.
class PythonGenerator {
 public:
  /// @param kind "maze", "cave", "office" or "open"
  /// @param options of the kind, by the names of the members of its struct
  /// @throws ConfigError for an unknown kind; pybind11::type_error for an unknown option and a value that is no number
  PythonGenerator(std::string kind, TeamOptions team, const pybind11::dict& options);

  const std::string& kind() const { return kind_; }
  /// The arguments of the constructor: kind, robots, types, controller, gold, options.
  pybind11::tuple arguments() const;
  /// @throws ConfigError for values out of bounds and an unknown robot type
  std::shared_ptr<PythonWorld> generate(std::uint64_t seed) const;
  /// Makes the same worlds for a batch, without parsing. @throws ConfigError as generate()
  WorldGenerator forEpisodes() const;

 private:
  std::string kind_;
  TeamOptions team_;
  pybind11::dict options_;
  WorldGenerator::MakeScenery make_;
};

/// Python's World.generate().
/// @throws as PythonGenerator
std::shared_ptr<PythonWorld> generatedWorld(const std::string& kind, Seed seed,
                                            WholeNumber<"robots", int, "0 to 1000000"> robots,
                                            std::vector<std::string> types, std::string controller, bool gold,
                                            const pybind11::kwargs& options);

void bindGenerator(pybind11::module_& module);

}  // namespace robosim
