#include "run/observer.h"

#include "run/collection.h"
#include "run/coverage.h"
#include "run/effort.h"
#include "run/soccer_referee.h"

namespace robosim {
namespace {

ObserverRegistry ownObservers() {
  ObserverRegistry registry;
  registry.add(coverageType());
  registry.add(effortType());
  registry.add(collectionType());
  registry.add(soccerRefereeType());
  return registry;
}

}  // namespace

ObserverRegistry& observers() {
  static ObserverRegistry registry = ownObservers();
  return registry;
}

}  // namespace robosim
