#include "run/seeded_run.h"

#include <chrono>

#include "base/seconds.h"

namespace robosim {

std::optional<RunSummary> runSeeded(const LoadedWorld& world, const RandomStarts& starts, const SeededRun& how,
                                    const std::function<bool()>& is_interrupted,
                                    const std::function<void(const Environment&)>& observe) {
  const auto start = std::chrono::steady_clock::now();
  LoadedWorld shuffled = world;
  setStartPoses(shuffled.fleet, starts.draw(how.seed));
  RunOptions options;
  options.environment = {.seed = how.seed, .period_s = how.period_s, .threads = 1};
  options.controller = how.controller;
  options.observers = how.observers;
  options.observers_log = false;
  options.breakdown_mean_s = how.breakdown_mean_s;
  options.takes_pictures = needPictures(shuffled.fleet, how.controller, how.observers);
  options.pictures_on_request = !readPictures(how.observers);
  LocalRun run(std::move(shuffled), options);
  const auto is_time_up = [&] {
    const SimTime now = run.environment().time();
    return now.seconds() + now.period_s / 2 > how.time_s;
  };
  if (observe) observe(run.environment());
  while (!run.isOver() && !is_time_up()) {
    if (is_interrupted()) return std::nullopt;
    run.step();
    if (observe) observe(run.environment());
  }
  RunSummary summary = RunSummary::of(run);
  summary.world = world.world.name;
  summary.seed = how.seed;
  summary.ended_by = endedByItself(run);
  summary.wall_s = secondsSince(start);
  return summary;
}

}  // namespace robosim
