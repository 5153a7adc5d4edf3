#include "robosim/robosim_main.h"

#include <iostream>
#include <string>

#include "base/error_list.h"
#include "distributed/ranks/launcher.h"
#include "robosim/loaded_function.h"
#include "robosim/plugin_options.h"
#include "robosim/program.h"
#include "robosim/program_ranks.h"
#include "robosim/subcommands.h"
#include "run/outputs/standard_parts.h"

namespace robosim {
namespace {

using AddSubcommands = void (*)(CLI::App& program);

void addRunSubcommands(CLI::App& program) {
  for (const auto add : {addRun, addReplay, addCheck, addExport, addConvert, addFit, addGenerate, addControllers,
                         addSensors, addObservers, addBench}) {
    add(program);
  }
}

AddSubcommands netSubcommands() {
  return loadedFunction<AddSubcommands>("librobosim-serving.so." ROBOSIM_SOVERSION, "robosimAddNetSubcommands");
}

AddSubcommands viewSubcommands() {
  return loadedFunction<AddSubcommands>("librobosim-viewing.so." ROBOSIM_SOVERSION, "robosimAddViewSubcommands");
}

/// For the error that an unknown option is one of another subcommand.
void addAllSubcommands(CLI::App& program) {
  addRunSubcommands(program);
  netSubcommands()(program);
  viewSubcommands()(program);
}

AddSubcommands subcommandsFor(int argc, char** argv) {
  const Subcommand* subcommand = argc > 1 ? subcommandNamed(argv[1]) : nullptr;
  if (!subcommand) return addNames;
  const std::string_view part = partFor(*subcommand, argc, argv);
  if (part == "robosim-net") return netSubcommands();
  if (part == "robosim-view") return viewSubcommands();
  return addRunSubcommands;
}

}  // namespace

int robosimMain(int argc, char** argv, const Registry& registry) {
  try {
    addToProgram(registry);
    useStandardParts();
  } catch (const std::exception& error) {
    std::cerr << "robosim: " << error.what() << '\n';
    return kBadInput;
  }
  try {
    replaceHelpSubcommand(argc, argv);
    ProgramRanks ranks(argc, argv);
    return ranks.execute([&] {
      return executeRobosim({subcommandsFor(argc, argv), addPluginOptions}, argc, argv, addAllSubcommands);
    });
  } catch (const ConfigError& error) {
    // All processes have the same error; mpirun would end rank 0 before its message if another one failed first.
    if (launchedRank().rank > 0) return kDone;
    std::cerr << "robosim: " << error.what() << '\n';
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "robosim: " << error.what() << '\n';
    return kRunFailed;
  }
}

}  // namespace robosim
