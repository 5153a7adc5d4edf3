#include "robosim/plugin_options.h"
#include "robosim/program.h"
#include "robosim/subcommands.h"

int main(int argc, char** argv) {
  using namespace robosim;
  return executeRobosim({addServe, addArcos, addRobot, addRemote, addGeometry, addControl, addPluginOptions}, argc, argv);
}
