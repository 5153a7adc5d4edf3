// `robosim run` with --foxglove, --ros2 or --web: a run of this process, served on this machine.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/seconds.h"
#include "net/host_port.h"
#include "robosim/ros2_options.h"
#include "robosim/run_command.h"
#include "robosim/subcommands.h"
#include "serving/live_serving.h"

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

LiveOptions localOptions(const LiveArguments& arguments, RosDistribution distribution) {
  LiveOptions options;
  options.log = [](const std::string& line) { logInfo("run", line); };
  options.ros2 = ros2Options(arguments.ros2, distribution, false, options.log);
  if (!arguments.web.empty()) {
    options.page.emplace();
    options.page->server.listen = livePageAddress(arguments.web);
    options.page->server.log = options.log;
    if (!isLoopback(options.page->server.listen)) {
      throw ConfigError("--web " + arguments.web +
                        ": other machines could change the run; use 127.0.0.1, or 'robosim " +
                        "serve --web', which has TLS and tokens");
    }
  }
  if (arguments.foxglove.empty()) return options;
  options.foxglove.emplace();
  options.foxglove->server.listen = foxgloveAddress(arguments.foxglove);
  options.foxglove->server.log = options.log;
  if (!isLoopback(options.foxglove->server.listen)) {
    throw ConfigError("--foxglove " + arguments.foxglove + ": other machines could drive the robots; use 127.0.0.1, " +
                      "or 'robosim serve --foxglove', which has TLS and tokens");
  }
  return options;
}

EndedBy serveRun(LocalRun& run, const RunArguments& arguments, const LiveArguments& live, double speed,
                 const ObserveStep& observe) {
  constexpr std::chrono::milliseconds kNap(10);  // requests are handled in between
  const Interrupt interrupt;
  LiveServing serving(localOptions(live, arguments.distribution));
  const std::string run_id = std::to_string(std::random_device()());
  std::vector<std::string> why_not_driven(run.environment().robotCount());
  serving.begin(run, run_id, arguments.run.environment.seed, why_not_driven);
  const auto follow_additions = [&] {
    if (run.environment().robotCount() == why_not_driven.size()) return;
    run.followAdditions();
    why_not_driven.resize(run.environment().robotCount());
    serving.addRobots(run, why_not_driven);
  };
  const Intervene intervene = [&run](const Intervention& change) { return run.environment().apply(change); };
  // Of robots whose pictures are subscribed to; no effect for a run that takes all.
  const auto request_pictures = [&] {
    std::vector<std::uint8_t> robots = serving.pictured();
    robots.resize(run.environment().robotCount());
    run.takePictures(robots);
    run.selectPictures(std::move(robots));
  };
  RunControl control;
  control.speed = speed;
  observe();
  Clock::time_point due = Clock::now();
  while (!run.isOver()) {
    if (interrupt.isRequested()) return EndedBy::interrupt;
    if (arguments.timeIsUp(run.environment().time())) return EndedBy::time_limit;
    const double former_speed = control.speed;
    request_pictures();
    serving.poll(control, {}, run.isOver(), intervene);
    follow_additions();
    const auto now = Clock::now();
    if (!control.mayStep() || control.speed != former_speed) due = now;
    if (!control.mayStep() || now < due) {
      std::this_thread::sleep_for(control.mayStep() ? std::min<Clock::duration>(kNap, due - now) : kNap);
      continue;
    }
    run.step(observe);
    follow_additions();
    serving.stepped();
    if (control.steps_left > 0) --control.steps_left;
    if (control.speed > 0) due += fromSeconds(run.environment().time().period_s / control.speed);
  }
  return endedByItself(run);
}

}  // namespace

void addRunWithServer(CLI::App& program) { addRunCommand(program, {}, serveRun); }

}  // namespace robosim
