#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/interrupt.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "outputs/run_outputs.h"
#include "recording/recording_error.h"
#include "replay/run_tables.h"
#include "robosim/arguments.h"
#include "robosim/run_arguments.h"
#include "robosim/run_command.h"
#include "robosim/subcommands.h"
#include "run/local_run.h"
#include "run/output_files.h"

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

struct LocalRunArguments : RunArguments {
  std::string csv, npz;  ///< files; empty for none

  std::vector<RecordingOutput> tables() const {
    std::vector<RecordingOutput> tables;
    if (!csv.empty()) tables.push_back({csv, RecordingFormat::csv});
    if (!npz.empty()) tables.push_back({npz, RecordingFormat::npz});
    return tables;
  }
};

std::string progressText(const LocalRun& run, double wall_s) {
  const State& state = run.environment().state();
  const auto active = std::count(state.activity.begin(), state.activity.end(), Activity::active);
  const double sim_s = state.time.seconds();
  return "simulated " + fixed(sim_s, 1) + " s, " +
         withCommas(static_cast<std::uint64_t>(sim_s / std::max(1e-9, wall_s))) + " times real time, " +
         std::to_string(active) + " of " + std::to_string(state.activity.size()) +
         " robots active (Ctrl-C ends the run)";
}

/// Sleeps until a time, in short intervals, because an interrupt does not wake it. @return false when interrupted
bool waitUntil(std::chrono::time_point<Clock, std::chrono::duration<double>> then, const Interrupt& interrupt) {
  constexpr std::chrono::duration<double> kNap(0.05);
  while (Clock::now() < then && !interrupt.isRequested()) {
    std::this_thread::sleep_for(std::min<std::chrono::duration<double>>(kNap, then - Clock::now()));
  }
  return !interrupt.isRequested();
}

EndedBy drive(LocalRun& run, const RunArguments& arguments, const Interrupt& interrupt, const ObserveStep& observe) {
  const double speed = speedNumber(arguments.speed);
  Progress progress;
  const auto start = Clock::now();
  observe();
  while (!run.isOver()) {
    const SimTime now = run.environment().time();
    if (interrupt.isRequested()) return EndedBy::interrupt;
    if (arguments.timeIsUp(now)) return EndedBy::time_limit;
    if (speed > 0 && !waitUntil(start + std::chrono::duration<double>(now.seconds() / speed), interrupt)) {
      return EndedBy::interrupt;
    }
    run.step();
    observe();
    if (progress.due()) {
      progress.show(progressText(run, std::chrono::duration<double>(Clock::now() - start).count()));
    }
  }
  return endedByItself(run);
}

/// @param window of --view; null: none
void runWorld(const LocalRunArguments& arguments, const RunWindow& window, double window_speed) {
  std::optional<Interrupt> interrupt(std::in_place);
  checkRunArguments(arguments);
  refuseSameFile({{"WORLD", arguments.world},
                  {"--record", arguments.record},
                  {"--picture", arguments.picture},
                  {"--csv", arguments.csv},
                  {"--npz", arguments.npz}});
  const bool is_recorded = !arguments.record.empty() || !arguments.tables().empty();
  std::optional<WorldSource> source;  // kept for the recording's note
  if (is_recorded || !arguments.changes.isNone()) source = sourceOf(arguments);
  LocalRun run(source ? loadWorldToRun(*source, arguments.run.controller)
                      : loadWorldToRun(arguments.world, arguments.run.controller, arguments.run.environment.seed),
               arguments.run);
  const RunNote note = is_recorded ? noteOf(*source, run, arguments.run) : RunNote();
  RunOutputs outputs(arguments, run.environment(), note);
  RunTables tables(arguments.tables(), arguments.world, run.environment(), note);
  const ObserveStep observe = [&] {
    outputs.observe(run.environment());
    tables.observe(run.environment());
  };
  const auto start = Clock::now();
  EndedBy ended_by = EndedBy::all_halted;
  try {
    if (window) {
      interrupt.reset();  // the window has one of its own
      ended_by = window(run, arguments, window_speed, observe);
    } else {
      ended_by = drive(run, arguments, *interrupt, observe);
    }
  } catch (const RecordingError&) {
    throw;
  } catch (...) {
    outputs.keep(run.environment());
    tables.keep();
    throw;
  }
  outputs.finish(run, std::chrono::duration<double>(Clock::now() - start).count(), ended_by);
  tables.finish();
  for (const auto& table : tables.tables()) {
    if (!arguments.json) std::cout << "table     " << printableText(table.file.string()) << std::endl;
  }
  if (ended_by == EndedBy::interrupt) throw Interrupted("interrupted; all outputs cover the steps before");
}

}  // namespace

void addRunCommand(CLI::App& program, const RunWindow& window) {
  auto* command = addSubcommand(program, "run");
  auto arguments = std::make_shared<LocalRunArguments>();
  addRunArguments(*command, *arguments);
  command
      ->add_option("--csv", arguments->csv,
                   "write all values as comma-separated values, one row per robot and step, as 'robosim export' does")
      ->type_name("FILE")
      ->check(fileName());
  command->add_option("--npz", arguments->npz, "the same as NumPy's arrays, for each robot and sensor")
      ->type_name("FILE")
      ->check(fileName());
  auto has_view = std::make_shared<bool>(false);
  command->add_flag(
      std::string(kViewOption), *has_view,
      "show the run in a window, in real time unless --speed is given; closing the window ends the run, and "
      "the window stays open after the run has ended; keys as for 'robosim view'");
  command->footer(controllersHelp);
  command->callback([arguments, window, command, has_view] {
    const bool has_speed = command->count("--speed") > 0;
    if (!*has_view) return runWorld(*arguments, {}, 0);
    if (!window) throw ConfigError("--view: is a feature of the command 'robosim run', which starts robosim-view");
    runWorld(*arguments, window, has_speed ? speedNumber(arguments->speed) : 1);
  });
}

void addRun(CLI::App& program) { addRunCommand(program, {}); }

}  // namespace robosim
