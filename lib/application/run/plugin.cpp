#include "run/plugin.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>

#include <dlfcn.h>

#include "base/error_list.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// Handles of loaded plugins, which stay loaded: objects of their types may exist until the program ends.
std::vector<void*>& loadedPlugins() {
  static std::vector<void*> handles;
  return handles;
}

const Plugin& pluginIn(void* handle, const std::string& name) {
  using Function = const Plugin* (*)();
  const auto function = reinterpret_cast<Function>(dlsym(handle, "robosimPlugin"));
  if (!function) {
    throw ConfigError(name + ": is a shared library but no plugin: it has no function robosimPlugin; define it with " +
                      "ROBOSIM_PLUGIN (run/plugin.h)");
  }
  const Plugin* plugin = function();
  const std::string abi = plugin && plugin->abi ? plugin->abi : "an unknown version";
  if (abi != ROBOSIM_PLUGIN_ABI) {
    throw ConfigError(name + ": was built for " + abi + ", and this program is " + ROBOSIM_PLUGIN_ABI +
                      "; build it again");
  }
  return *plugin;
}

/// What a plugin adds. Its exceptions are copied to a ConfigError, because their type may be unloaded with it.
Registry typesOf(const Plugin& plugin, const std::string& name) {
  Registry registry;
  try {
    plugin.add_types(registry);
  } catch (const std::exception& error) {
    throw ConfigError(name + ": the plugin threw an exception: " + error.what());
  } catch (...) {
    throw ConfigError(name + ": the plugin threw an exception: an object that is not a std::exception");
  }
  return registry;
}

}  // namespace

void loadPlugin(const fs::path& file) {
  const std::string name = file.string();
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    throw ConfigError(name + ": there is no such file; fix the name of the plugin");
  void* const handle = dlopen(fs::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    throw ConfigError(name + ": cannot be loaded as a plugin: " + dlerror() +
                      "; build it for this program, RoboSim " ROBOSIM_VERSION);
  }
  auto& loaded = loadedPlugins();
  if (std::find(loaded.begin(), loaded.end(), handle) != loaded.end()) return;
  const Plugin& plugin = pluginIn(handle, name);
  const Registry types = typesOf(plugin, name);
  try {
    addToProgram(types);
  } catch (const ConfigError& conflict) {
    throw ConfigError(name + ": " + conflict.what());
  }
  loaded.push_back(handle);
}

void loadPluginsInPath() {
  const char* const path = std::getenv("ROBOSIM_PLUGIN_PATH");
  if (!path) return;
  std::istringstream folders(path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (folder.empty()) continue;
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
      if (it->path().extension() == ".so") files.push_back(it->path());
    }
    if (error) {
      throw ConfigError("ROBOSIM_PLUGIN_PATH: cannot read the folder " + folder + ": " + error.message() +
                        "; fix its name, or remove it from the variable");
    }
    std::sort(files.begin(), files.end());
    for (const auto& file : files) loadPlugin(file);
  }
}

}  // namespace robosim
