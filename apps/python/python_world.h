#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <pybind11/pybind11.h>

#include "robots/world_source.h"

namespace robosim {

/// Python's class World: a world that does not change, and the files that it was made of. Simulations copy it.
struct PythonWorld {
  WorldSource source;
  LoadedWorld loaded;
  std::uint64_t seed = kDefaultSeed;  ///< of the places of scattered robots and objects

  /// @throws ConfigError
  static std::shared_ptr<PythonWorld> load(const std::filesystem::path& file, std::uint64_t seed);
  static std::shared_ptr<PythonWorld> parse(std::string text, const std::filesystem::path& file, std::uint64_t seed);
};

void bindWorld(pybind11::module_& module);
/// The classes that describe the contents of a world.
void bindDescriptions(pybind11::module_& module);

}  // namespace robosim
