#include "run/observer.h"

#include "run/coverage.h"

namespace robosim {
namespace {

ObserverRegistry ownObservers() {
  ObserverRegistry registry;
  registry.add(coverageType());
  return registry;
}

}  // namespace

ObserverRegistry& observers() {
  static ObserverRegistry registry = ownObservers();
  return registry;
}

}  // namespace robosim
