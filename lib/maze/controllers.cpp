#include "maze/controllers.h"

#include "maze/gold_finder.h"
#include "maze/still.h"
#include "maze/wall_follower.h"
#include "maze/wander.h"

namespace robosim {
namespace {

using Made = std::unique_ptr<Controller>;

ControllerRegistry own() {
  ControllerRegistry registry;
  registry.add(
      {"gold_finder",
       "Searches an unknown maze for gold, sends GOLD to its neighbour, and halts.",
       {SensorKind::odometry, SensorKind::heat},
       {{"heat_threshold_celsius", GoldFinderOptions{}.heat_threshold, 0, 1e6, "°C", "heat above this means gold"}},
       [](const ControllerSetup& setup, const ParameterValues& parameters) -> Made {
         return std::make_unique<GoldFinder>(setup, GoldFinderOptions{parameters["heat_threshold_celsius"]});
       }});
  registry.add(
      {"wander",
       "Drives about at random and avoids what is near.",
       {},
       {},
       [](const ControllerSetup& setup, const ParameterValues&) -> Made { return std::make_unique<Wander>(setup); }});
  registry.add({"wall_follower",
                "Follows the wall on its right.",
                {SensorKind::sonar},
                {{"distance_radii", WallFollowerOptions{}.distance_radii, 0.5, 10, "robot radii",
                  "distance between the robot's edge and the wall"}},
                [](const ControllerSetup& setup, const ParameterValues& parameters) -> Made {
                  return std::make_unique<WallFollower>(setup, WallFollowerOptions{parameters["distance_radii"]});
                }});
  registry.add({"still", "Does nothing.", {}, {}, [](const ControllerSetup&, const ParameterValues&) -> Made {
                  return std::make_unique<Still>();
                }});
  return registry;
}

}  // namespace

ControllerRegistry& controllers() {
  static ControllerRegistry registry = own();
  return registry;
}

}  // namespace robosim
