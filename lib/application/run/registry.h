#pragma once
#include <vector>

#include "control/controller_registry.h"
#include "hardware/added_codecs.h"
#include "run/observer.h"
#include "sensors/registry.h"

namespace robosim {

/// Controllers, sensors and observers that are not part of RoboSim.
struct Registry {
  ControllerRegistry controllers;
  std::vector<SensorType> sensors;
  /// How measurements of the kind SensorKind::values are recorded, if not as CObservationRawDAQ; each must stay valid.
  /// Codecs are classes of the library robosim::recording (recording/codec.h).
  std::vector<const Codec*> codecs = {};
  ObserverRegistry observers = {};
};

/// Adds all of a registry to this program, before its first run, or nothing.
/// @throws ConfigError for a name that is known already
void addToProgram(const Registry& registry);

}  // namespace robosim
