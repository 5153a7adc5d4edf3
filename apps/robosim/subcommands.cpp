#include "robosim/subcommands.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

namespace robosim {

const Subcommand* subcommandNamed(std::string_view name) {
  const auto found = std::find_if(kSubcommands.begin(), kSubcommands.end(),
                                  [name](const Subcommand& subcommand) { return subcommand.name == name; });
  return found == kSubcommands.end() ? nullptr : &*found;
}

CLI::App* addSubcommand(CLI::App& program, std::string_view name) {
  const Subcommand* subcommand = subcommandNamed(name);
  if (!subcommand) throw std::invalid_argument("kSubcommands has no " + std::string(name));
  return program.add_subcommand(subcommand->name, subcommand->help);
}

}  // namespace robosim
