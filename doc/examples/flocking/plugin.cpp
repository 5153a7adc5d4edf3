#include <robosim/run/plugin.h>

#include "types.h"

ROBOSIM_PLUGIN(registry) { addTypes(registry); }
