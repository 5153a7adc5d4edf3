#include "robosim/program.h"
#include "robosim/subcommands.h"

int main(int argc, char** argv) {
  using namespace robosim;
  return executeRobosim({addView, addRunWithWindow}, argc, argv);
}
