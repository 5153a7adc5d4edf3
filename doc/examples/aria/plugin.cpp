#include <robosim/run/plugin.h>

#include "types.h"

ROBOSIM_PLUGIN(registry) {
  registry.controllers.add(wanderType());
  registry.controllers.add(teleopType());
  registry.controllers.add(gotoType());
}
