#include "robosim/program.h"
#include "robosim/subcommands.h"

int main(int argc, char** argv) {
  using namespace robosim;
  return executeRobosim({addRun, addReplay, addCheck, addExport, addGenerate, addControllers, addSensors, addBench},
                        argc, argv);
}
