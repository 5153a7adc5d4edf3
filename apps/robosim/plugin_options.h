#pragma once
#include <string>
#include <vector>

#include "robosim/cli11_names.h"

namespace robosim {

/// Adds `--plugin` to all subcommands that read worlds or run controllers, and loads the plugins of ROBOSIM_PLUGIN_PATH
/// before the arguments are parsed. To be called after the subcommands are added.
void addPluginOptions(CLI::App& program);

/// The values of `--plugin` so far, as given.
const std::vector<std::string>& pluginArguments();

}  // namespace robosim
