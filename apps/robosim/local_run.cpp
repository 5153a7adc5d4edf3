#include "robosim/local_run.h"

#include <algorithm>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "maze/controllers.h"
#include "rendering/offscreen_renderer.h"

namespace robosim {
namespace {

void checkToRun(const LoadedWorld& world, const std::string& file, const std::string& instead) {
  ErrorList errors;
  checkControllers(world, file, instead, errors);
  errors.throwIfAny();
  if (world.fleet.robots.empty()) throw ConfigError(file + ": has no robot, so nothing would happen; add one");
}

std::unique_ptr<ImageSource> imagesFor(const LoadedWorld& world) {
  if (!hasCamera(world.fleet)) return nullptr;
  return std::make_unique<OffscreenRenderer>(world.world, world.fleet);
}

}  // namespace

std::string controllerOf(const FleetRobot& robot, const std::string& instead) {
  if (!instead.empty()) return instead;
  return robot.controller.empty() ? kDefaultController : robot.controller;
}

void checkControllers(const LoadedWorld& world, const std::string& world_file, const std::string& instead,
                      ErrorList& errors) {
  const std::size_t count = std::min(world.world.robots.size(), world.fleet.robots.size());
  for (std::size_t i = 0; i < count; ++i) {
    const FleetRobot& robot = world.fleet.robots[i];
    const std::string name = controllerOf(robot, instead);
    const auto known = controllerNames();
    if (std::find(known.begin(), known.end(), name) == known.end()) continue;  // told by buildFleet()
    for (const SensorKind kind : controllerType(name).needs) {
      const auto& sensors = *robot.info.sensors;
      if (std::any_of(sensors.begin(), sensors.end(), [&](const SensorInfo& s) { return s.kind == kind; })) continue;
      errors.add(world_file, world.world.robots[i].line.number,
                 "robot '" + robot.info.name + "': its controller " + name + " needs a sensor of the kind " +
                     nameOf(kind) + "; add one, or take another controller");
    }
  }
}

LoadedWorld loadWorldToRun(const std::string& file, const std::string& instead) {
  LoadedWorld world = loadWorld(file, controllerNames());
  checkToRun(world, file, instead);
  // The fleet has made of them what runs. (= {} would keep the memory.)
  world.world.robots = std::vector<RobotPlacement>();
  world.world.objects.shrink_to_fit();
#ifdef __GLIBC__
  // Reading a file takes several times the memory of the world that comes of it. It is free by now, but strewn with
  // what is kept, so that the process would hold on to it.
  malloc_trim(0);
#endif
  return world;
}

LoadedWorld loadWorldToRun(const WorldSource& source, const std::string& instead) {
  LoadedWorld world = loadWorld(source, controllerNames());
  checkToRun(world, source.file, instead);
  return world;
}

LocalRun::LocalRun(LoadedWorld world, const RunOptions& options, const std::vector<std::uint8_t>& elsewhere)
    : images_(imagesFor(world)),
      environment_(std::move(world.world), std::move(world.fleet), options.environment, images_.get()),
      workers_(options.environment.threads) {
  const auto& robots = environment_.fleet().robots;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!elsewhere.empty() && elsewhere[i]) continue;
    const ControllerSetup setup{options.environment.seed, static_cast<std::uint32_t>(i)};
    seats_.push_back(
        std::make_unique<Seat>(environment_, i, makeController(controllerOf(robots[i], options.controller), setup)));
  }
}

void LocalRun::step() {
  decide();
  environment_.step();
  noteOutcome();
}

void LocalRun::decide() {
  constexpr std::size_t kChunk = 16;
  workers_.forEach(seats_.size(), kChunk, [&](std::size_t i) { seats_[i]->controller->step(seats_[i]->robot); });
}

void LocalRun::noteOutcome() {
  const State& state = environment_.state();
  if (!gold_.found_s) {
    for (std::size_t i = 0; i < state.activity.size(); ++i) {
      if (state.activity[i] != Activity::found) continue;
      gold_.found_by = environment_.fleet().robots[i].info.name;
      gold_.found_s = state.time.seconds();
      break;
    }
  }
  if (state.winner && !gold_.won_by) {
    gold_.won_by = environment_.fleet().robots[*state.winner].info.name;
    gold_.won_s = state.time.seconds();
  }
  if (!gold_.all_halted_s && environment_.allHalted()) gold_.all_halted_s = state.time.seconds();
}

}  // namespace robosim
