#pragma once
#include <robosim/run/registry.h>

/// The controller `flocking`: turns away from near objects, and otherwise into the wind.
robosim::ControllerType flockingType();

/// The sensor <anemometer>, which measures the apparent wind of a moving robot in a uniform wind, and its recording as
/// CObservationWindSensor.
robosim::SensorType anemometerType();
const robosim::Codec& windCodec();

/// The observer `alignment`: how well the robots' headings agree.
robosim::ObserverType alignmentType();

inline void addTypes(robosim::Registry& registry) {
  registry.controllers.add(flockingType());
  registry.sensors.push_back(anemometerType());
  registry.codecs.push_back(&windCodec());
  registry.observers.add(alignmentType());
}
