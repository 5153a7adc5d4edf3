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

SubcommandLibrary libraryFor(const Subcommand& subcommand, int argc, char** argv) {
  if (subcommand.name != std::string_view("run")) return subcommand.contained_in;
  if (hasOption(kViewOption, argc, argv)) return SubcommandLibrary::viewing;
  const bool is_served =
      hasOption(kFoxgloveOption, argc, argv) || hasOption(kRos2Option, argc, argv) || hasOption(kWebOption, argc, argv);
  return is_served ? SubcommandLibrary::serving : subcommand.contained_in;
}

const char* partFor(SubcommandLibrary library) {
  switch (library) {
    case SubcommandLibrary::serving:
      return "robosim-net";
    case SubcommandLibrary::viewing:
      return "robosim-view";
    default:
      return "robosim-run";
  }
}

bool hasOption(std::string_view option, int argc, char** argv) {
  return std::any_of(argv + 2, argv + argc, [&](const std::string_view argument) {
    return argument.substr(0, option.size()) == option &&
           (argument.size() == option.size() || argument[option.size()] == '=');
  });
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
