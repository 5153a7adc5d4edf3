#include "robosim/robosim_main.h"

int main(int argc, char** argv) { return robosim::robosimMain(argc, argv, {}); }
