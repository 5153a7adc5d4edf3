// The subcommands in the library robosim-program; robosimMain() looks this function up by its name.
#include "robosim/subcommands.h"

extern "C" __attribute__((visibility("default"))) void robosimAddProgramSubcommands(CLI::App& program) {
  using namespace robosim;
  for (const auto add : {addReplay, addExport, addFit, addBench}) add(program);
}
