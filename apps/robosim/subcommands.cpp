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

const char* partFor(const Subcommand& subcommand, int argc, char** argv) {
  const bool is_run = subcommand.name == std::string_view("run");
  return is_run && std::find(argv + 2, argv + argc, kViewOption) != argv + argc ? subcommandNamed("view")->part
                                                                                : subcommand.part;
}

void addNames(CLI::App& program) {
  for (const auto& subcommand : kSubcommands) addSubcommand(program, subcommand.name);
}

CLI::App* addSubcommand(CLI::App& program, std::string_view name) {
  const Subcommand* subcommand = subcommandNamed(name);
  if (!subcommand) throw std::invalid_argument("kSubcommands has no " + std::string(name));
  return program.add_subcommand(subcommand->name, subcommand->help);
}

}  // namespace robosim
