#pragma once
#include "control/controller_type.h"
#include "control/type_registry.h"

namespace robosim {

/// Known kinds of controllers.
using ControllerRegistry = TypeRegistry<ControllerType>;

}  // namespace robosim
