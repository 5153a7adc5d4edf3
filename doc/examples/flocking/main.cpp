#include <robosim/robosim_main.h>

#include "types.h"

int main(int argc, char** argv) {
  robosim::Registry registry;
  addTypes(registry);
  return robosim::robosimMain(argc, argv, registry);
}
