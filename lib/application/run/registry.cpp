#include "run/registry.h"

#include "maze/controllers.h"

namespace robosim {

void addToProgram(const Registry& registry) {
  ControllerRegistry all = controllers();
  for (const auto& type : registry.controllers.types()) all.add(type);
  ObserverRegistry all_observers = observers();
  for (const auto& type : registry.observers.types()) all_observers.add(type);
  addSensorTypes(registry.sensors);
  controllers() = std::move(all);
  observers() = std::move(all_observers);
  for (const Codec* codec : registry.codecs) addedCodecs().insert(addedCodecs().begin(), codec);
}

}  // namespace robosim
