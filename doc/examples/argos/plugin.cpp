#include <robosim/run/plugin.h>

#include "types.h"

ROBOSIM_PLUGIN(registry) {
  registry.controllers.add(argosDiffusionType());
  registry.controllers.add(argosFlockingType());
  registry.controllers.add(argosForagingType());
  registry.observers.add(argosFoodType());
}
