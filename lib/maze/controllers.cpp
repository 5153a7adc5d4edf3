#include "maze/controllers.h"

#include "base/error_list.h"
#include "maze/gold_finder.h"
#include "maze/still.h"
#include "maze/wall_follower.h"
#include "maze/wander.h"

namespace robosim {
namespace {

const ControllerType kTypes[] = {
    {"gold_finder",
     "Searches an unknown maze for gold, sends GOLD to its neighbour, and halts.",
     {SensorKind::odometry, SensorKind::heat},
     [](const ControllerSetup& setup) -> std::unique_ptr<Controller> { return std::make_unique<GoldFinder>(setup); }},
    {"wander",
     "Drives about at random and avoids what is near.",
     {},
     [](const ControllerSetup& setup) -> std::unique_ptr<Controller> { return std::make_unique<Wander>(setup); }},
    {"wall_follower",
     "Follows the wall on its right.",
     {SensorKind::sonar},
     [](const ControllerSetup& setup) -> std::unique_ptr<Controller> { return std::make_unique<WallFollower>(setup); }},
    {"still",
     "Does nothing.",
     {},
     [](const ControllerSetup&) -> std::unique_ptr<Controller> { return std::make_unique<Still>(); }},
};

}  // namespace

std::span<const ControllerType> controllerTypes() { return kTypes; }

std::vector<std::string> controllerNames() {
  std::vector<std::string> names;
  for (const ControllerType& type : kTypes) names.emplace_back(type.name);
  return names;
}

const ControllerType& controllerType(const std::string& name) {
  std::string known;
  for (const ControllerType& type : kTypes) {
    if (name == type.name) return type;
    known += (known.empty() ? "" : ", ") + std::string(type.name);
  }
  throw ConfigError("there is no controller '" + name + "'; take one of " + known);
}

std::unique_ptr<Controller> makeController(const std::string& name, const ControllerSetup& setup) {
  return controllerType(name).make(setup);
}

}  // namespace robosim
