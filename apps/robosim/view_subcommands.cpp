// The subcommands in the library robosim-viewing; robosimMain() looks this function up by its name.
#include "robosim/subcommands.h"

extern "C" __attribute__((visibility("default"))) void robosimAddViewSubcommands(CLI::App& program) {
  using namespace robosim;
  for (const auto add : {addView, addRunWithWindow}) add(program);
}
