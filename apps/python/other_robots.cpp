#include "other_robots.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error_list.h"
#include "control/controller.h"
#include "control/controller_error.h"
#include "control/robot.h"
#include "environment/local_hardware.h"
#include "maze/controllers.h"
#include "run/known_world.h"
#include "run/local_run.h"

namespace robosim {
namespace {

void checkNeeds(const FleetRobot& robot) {
  const ControllerType& type = controllers().typeOf(*robot.controller);
  const std::string who = "robot '" + robot.info.name + "': its controller " + type.name;
  constexpr const char* kCure = "make the robot an agent, or use others=\"still\"";
  if (needsPictures(*robot.controller)) {
    throw ConfigError(who + " requires pictures, which learning environments do not take; " + kCure);
  }
  for (const SensorKind kind : missingSensors(type, *robot.info.sensors)) {
    throw ConfigError(who + " requires a sensor of kind " + nameOf(kind) + "; add one, " + kCure);
  }
}

class ControlledRobots : public OtherRobots {
 public:
  ControlledRobots(Environment& environment, std::size_t first) {
    const auto& robots = environment.fleet().robots;
    std::shared_ptr<const KnownWorld> known_world;  // made for the first robot that needs it
    for (std::size_t i = first; i < robots.size(); ++i) {
      const std::string& choice = *robots[i].controller;
      if (choice.empty()) continue;
      checkNeeds(robots[i]);
      ControllerSetup setup{environment.state().seed, static_cast<std::uint32_t>(i),
                            environment.state().world_from_robot[i]};
      if (knowsWorld(choice)) {
        if (!known_world) known_world = makeKnownWorld(environment.world(), environment.fleet());
        setup.known_world = known_world;
      }
      all_.push_back(std::make_unique<One>(environment, i, choice, makeController(choice, setup, robots[i].info.name)));
    }
  }

  bool isEmpty() const { return all_.empty(); }

  std::unique_ptr<OtherRobots> clone(Environment& environment) const override {
    auto copy = std::unique_ptr<ControlledRobots>(new ControlledRobots());
    for (const auto& one : all_) {
      copy->all_.push_back(std::make_unique<One>(environment, one->index, one->choice,
                                                 cloneController(*one->controller, one->choice, one->robot.name())));
    }
    return copy;
  }

  void act() override {
    for (const auto& one : all_) {
      try {
        one->controller->step(one->robot);
      } catch (...) {
        throwControllerError(one->choice, one->robot.name());
      }
    }
  }

 private:
  ControlledRobots() = default;

  struct One {
    std::size_t index;
    LocalHardware hardware;
    Robot robot;
    std::string choice;
    std::unique_ptr<Controller> controller;
    One(Environment& environment, std::size_t i, std::string chosen, std::unique_ptr<Controller> made)
        : index(i), hardware(environment, i), robot(hardware), choice(std::move(chosen)), controller(std::move(made)) {}
  };
  std::vector<std::unique_ptr<One>> all_;  // on the heap: each Robot refers to its LocalHardware
};

}  // namespace

void checkOtherRobots(const LoadedWorld& world, std::size_t first) {
  for (std::size_t i = first; i < world.fleet.robots.size(); ++i) {
    if (!world.fleet.robots[i].controller->empty()) checkNeeds(world.fleet.robots[i]);
  }
}

std::unique_ptr<OtherRobots> otherRobots(Environment& environment, std::size_t first) {
  auto robots = std::make_unique<ControlledRobots>(environment, first);
  if (robots->isEmpty()) return nullptr;
  return robots;
}

}  // namespace robosim
