#include <algorithm>
#include <chrono>
#include <thread>

#include <CLI/CLI.hpp>

#include "recording/recording_error.h"
#include "robosim/arguments.h"
#include "robosim/interrupt.h"
#include "robosim/local_run.h"
#include "robosim/progress.h"
#include "robosim/run_outputs.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

std::string progressText(const LocalRun& run, double wall_s) {
  const State& state = run.environment().state();
  const auto active = std::count(state.activity.begin(), state.activity.end(), Activity::active);
  const double sim_s = state.time.seconds();
  return "simulated " + fixed(sim_s, 1) + " s, " +
         withCommas(static_cast<std::uint64_t>(sim_s / std::max(1e-9, wall_s))) + " times real time, " +
         std::to_string(active) + " of " + std::to_string(state.activity.size()) +
         " robots active (Ctrl-C ends the run)";
}

/// Sleeps until then, in short naps, for an interrupt wakes nobody. @return whether nobody asked for the end meanwhile
bool waitUntil(std::chrono::time_point<Clock, std::chrono::duration<double>> then, const Interrupt& interrupt) {
  constexpr std::chrono::duration<double> kNap(0.05);
  while (Clock::now() < then && !interrupt.asked()) {
    std::this_thread::sleep_for(std::min<std::chrono::duration<double>>(kNap, then - Clock::now()));
  }
  return !interrupt.asked();
}

EndedBy drive(LocalRun& run, const RunArguments& arguments, const Interrupt& interrupt, RunOutputs& outputs) {
  const double speed = speedNumber(arguments.speed);
  Progress progress;
  const auto start = Clock::now();
  outputs.observe(run.environment());
  while (!run.gold().all_halted_s) {
    const SimTime now = run.environment().time();
    if (interrupt.asked()) return EndedBy::interrupt;
    if (arguments.timeIsUp(now)) return EndedBy::time_limit;
    if (speed > 0 && !waitUntil(start + std::chrono::duration<double>(now.seconds() / speed), interrupt)) {
      return EndedBy::interrupt;
    }
    run.step();
    outputs.observe(run.environment());
    if (progress.due()) {
      progress.show(progressText(run, std::chrono::duration<double>(Clock::now() - start).count()));
    }
  }
  return EndedBy::all_halted;
}

void runWorld(const RunArguments& arguments) {
  const Interrupt interrupt;
  arguments.check();
  std::optional<WorldSource> source;  // a recording keeps what it is of
  if (!arguments.record.empty()) source = readWorldSource(arguments.world);
  LocalRun run(source ? loadWorldToRun(*source, arguments.run.controller)
                      : loadWorldToRun(arguments.world, arguments.run.controller),
               arguments.run);
  RunOutputs outputs(arguments, run.environment(), source ? noteOf(*source, run, arguments.run) : RunNote());
  const auto start = Clock::now();
  EndedBy ended_by = EndedBy::all_halted;
  try {
    ended_by = drive(run, arguments, interrupt, outputs);
  } catch (const RecordingError&) {
    throw;
  } catch (...) {
    outputs.keep(run.environment());
    throw;
  }
  outputs.finish(run, std::chrono::duration<double>(Clock::now() - start).count(), ended_by);
}

}  // namespace

void addRun(CLI::App& program) {
  auto* command = program.add_subcommand("run", "Run a world in this process, as fast as it can");
  auto arguments = std::make_shared<RunArguments>();
  addRunArguments(*command, *arguments);
  command->footer(controllersHelp());
  command->callback([arguments] { runWorld(*arguments); });
}

}  // namespace robosim
