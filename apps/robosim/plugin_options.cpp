#include "robosim/plugin_options.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "run/plugin.h"

namespace robosim {
namespace {

/// These read no world.
constexpr std::array kWithoutPlugins{"remote", "control", "generate", "convert"};

/// Plugins are loaded once for the whole process.
std::vector<std::string>& pluginFiles() {
  static std::vector<std::string> files;
  return files;
}

void addTo(CLI::App& command) {
  const auto subcommands = command.get_subcommands([](CLI::App*) { return true; });
  if (subcommands.empty()) {
    command
        .add_option_function<std::vector<std::string>>(
            "--plugin",
            [](const std::vector<std::string>& files) {
              for (const auto& file : files) {
                loadPlugin(file);
                pluginFiles().push_back(file);
              }
            },
            "load this shared library, which adds controllers and sensors; repeatable. Those in the folders of "
            "ROBOSIM_PLUGIN_PATH are always loaded")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->trigger_on_parse();
  }
  for (CLI::App* subcommand : subcommands) {
    const auto is_this = [&](const char* name) { return subcommand->get_name() == name; };
    if (std::none_of(kWithoutPlugins.begin(), kWithoutPlugins.end(), is_this)) addTo(*subcommand);
  }
}

}  // namespace

const std::vector<std::string>& pluginArguments() { return pluginFiles(); }

void addPluginOptions(CLI::App& program) {
  addTo(program);
  program.preparse_callback([](std::size_t) { loadPluginsInPath(); });
}

}  // namespace robosim
