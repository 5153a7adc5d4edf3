// The executables robosim-run, robosim-net and robosim-view, which differ in the libraries that they load at their
// start.
#include "robosim/robosim_main.h"

int main(int argc, char** argv) { return robosim::robosimMain(argc, argv, {}); }
