#pragma once
#include "robosim/cli11_names.h"

namespace robosim {

/// Adds `--plugin` to all subcommands that read worlds or run controllers, and loads the plugins of ROBOSIM_PLUGIN_PATH
/// before the arguments are parsed. To be called after the subcommands are added.
void addPluginOptions(CLI::App& program);

}  // namespace robosim
