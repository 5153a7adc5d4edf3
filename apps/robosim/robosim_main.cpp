#include "robosim/robosim_main.h"

#include <iostream>
#include <string>

#include "base/error_list.h"
#include "base/loaded_function.h"
#include "distributed/ranks/launcher.h"
#include "robosim/plugin_options.h"
#include "robosim/program.h"
#include "robosim/program_ranks.h"
#include "robosim/subcommands.h"
#include "run/loaded_parts.h"

namespace robosim {
namespace {

using AddSubcommands = void (*)(CLI::App& program);

void addMainSubcommands(CLI::App& program) {
  for (const auto add : {addRun, addCheck, addConvert, addGenerate, addControllers, addSensors, addObservers}) {
    add(program);
  }
}

/// The subcommands in a library. Those of a network and of windows include `run`, with further options.
AddSubcommands subcommandsIn(SubcommandLibrary library) {
  switch (library) {
    case SubcommandLibrary::program:
      return programFunction<AddSubcommands>("robosimAddProgramSubcommands");
    case SubcommandLibrary::serving:
      return loadedFunction<AddSubcommands>("librobosim-serving.so." ROBOSIM_SOVERSION, "robosimAddNetSubcommands");
    case SubcommandLibrary::viewing:
      return loadedFunction<AddSubcommands>("librobosim-viewing.so." ROBOSIM_SOVERSION, "robosimAddViewSubcommands");
    default:
      return addMainSubcommands;
  }
}

/// For the error that an unknown option is one of another subcommand.
void addAllSubcommands(CLI::App& program) {
  for (const auto library :
       {SubcommandLibrary::main, SubcommandLibrary::program, SubcommandLibrary::serving, SubcommandLibrary::viewing}) {
    subcommandsIn(library)(program);
  }
}

AddSubcommands subcommandsFor(int argc, char** argv) {
  const Subcommand* subcommand = argc > 1 ? subcommandNamed(argv[1]) : nullptr;
  return subcommand ? subcommandsIn(libraryFor(*subcommand, argc, argv)) : addNames;
}

}  // namespace

int robosimMain(int argc, char** argv, const Registry& registry) {
  try {
    addToProgram(registry);
    useLoadedParts();
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
