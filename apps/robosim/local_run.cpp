#include "robosim/local_run.h"

#include "maze/controllers.h"

namespace robosim {

LocalRun::LocalRun(LoadedWorld world, const RunOptions& options)
    : environment_(std::move(world.world), std::move(world.fleet), options.environment),
      workers_(options.environment.threads) {
  const auto& robots = environment_.fleet().robots;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const std::string own = robots[i].controller.empty() ? kDefaultController : robots[i].controller;
    const ControllerSetup setup{options.environment.seed, static_cast<std::uint32_t>(i)};
    seats_.push_back(std::make_unique<Seat>(
        environment_, i, makeController(options.controller.empty() ? own : options.controller, setup)));
  }
}

void LocalRun::step() {
  constexpr std::size_t kChunk = 16;
  workers_.forEach(seats_.size(), kChunk, [&](std::size_t i) { seats_[i]->controller->step(seats_[i]->robot); });
  environment_.step();
  noteOutcome();
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
  if (!gold_.all_halted_s && environment_.allHalted()) gold_.all_halted_s = state.time.seconds();
}

}  // namespace robosim
