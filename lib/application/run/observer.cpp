#include "run/observer.h"

#include "run/coverage.h"
#include "run/effort.h"

namespace robosim {
namespace {

ObserverRegistry ownObservers() {
  ObserverRegistry registry;
  registry.add(coverageType());
  registry.add(effortType());
  return registry;
}

}  // namespace

ObserverRegistry& observers() {
  static ObserverRegistry registry = ownObservers();
  return registry;
}

}  // namespace robosim
