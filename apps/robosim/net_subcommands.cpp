// The subcommands in the library robosim-serving; robosimMain() looks this function up by its name.
#include "robosim/subcommands.h"

extern "C" __attribute__((visibility("default"))) void robosimAddNetSubcommands(CLI::App& program) {
  using namespace robosim;
  for (const auto add : {addServe, addRunWithServer, addArcos, addRobot, addRemote, addGeometry, addControl})
    add(program);
}
