#pragma once
#include <filesystem>

#include <mrpt/version.h>

#include "run/registry.h"

namespace robosim {

/// What a plugin's function robosimPlugin() returns. A plugin is a shared library with additional controllers,
/// sensors and observers:
///
///     ROBOSIM_PLUGIN(registry) {
///       registry.controllers.add({"flocking", "Flies in a flock.", …});
///     }
///
/// It is linked to the CMake target robosim::robosim, which defines ROBOSIM_VERSION.
struct Plugin {
  const char* abi;                     ///< ROBOSIM_PLUGIN_ABI when the plugin was compiled
  void (*add_types)(Registry& types);  ///< adds the plugin's types to an empty registry
};

/// Loads a plugin and adds its types to this program, before the first run. A file that is loaded already is ignored.
/// @throws ConfigError naming the file: it is missing, is no plugin, is one for another version of RoboSim, has thrown
/// an exception, or a name of its types is known already. The program then has none of its types.
void loadPlugin(const std::filesystem::path& file);

/// Loads all files *.so, by name, in the folders that the environment variable ROBOSIM_PLUGIN_PATH lists, separated by
/// colons.
/// @throws ConfigError as loadPlugin(), and for a folder that cannot be read
void loadPluginsInPath();

}  // namespace robosim

#define ROBOSIM_TEXT_OF(x) #x
#define ROBOSIM_NUMBER_TEXT(x) ROBOSIM_TEXT_OF(x)
/// What must agree between a program and its plugins, since they exchange C++ objects.
#define ROBOSIM_PLUGIN_ABI   \
  "RoboSim " ROBOSIM_VERSION \
  ", C++ ABI " ROBOSIM_NUMBER_TEXT(__GXX_ABI_VERSION) ", MRPT " ROBOSIM_NUMBER_TEXT(MRPT_VERSION)

// NOLINTBEGIN(bugprone-macro-parentheses): the argument is the name of a parameter
/// Defines the function of a plugin; followed by the body of a function that adds types to `registry`.
#define ROBOSIM_PLUGIN(registry)                                                             \
  static void robosimAddTypes(robosim::Registry& registry);                                  \
  extern "C" __attribute__((visibility("default"))) const robosim::Plugin* robosimPlugin() { \
    static constexpr robosim::Plugin plugin{ROBOSIM_PLUGIN_ABI, robosimAddTypes};            \
    return &plugin;                                                                          \
  }                                                                                          \
  static void robosimAddTypes(robosim::Registry& registry)
// NOLINTEND(bugprone-macro-parentheses)
