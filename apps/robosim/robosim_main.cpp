#include "robosim/robosim_main.h"

#include <iostream>

#include "robosim/plugin_options.h"
#include "robosim/program.h"
#include "robosim/subcommands.h"

namespace robosim {

int robosimMain(int argc, char** argv, const Registry& registry) {
  try {
    addToProgram(registry);
  } catch (const std::exception& error) {
    std::cerr << "robosim: " << error.what() << '\n';
    return kBadInput;
  }
  return executeRobosim({addRun, addReplay, addCheck, addExport, addGenerate, addControllers, addSensors, addObservers,
                         addBench, addPluginOptions},
                        argc, argv);
}

}  // namespace robosim
