#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/interrupt.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/seconds.h"
#include "base/text_table.h"
#include "distributed/distributed_run.h"
#include "distributed/ranks/agreement.h"
#include "recording/recording_error.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/run_arguments.h"
#include "robosim/run_command.h"
#include "robosim/run_files.h"
#include "robosim/subcommands.h"
#include "run/loaded_parts.h"
#include "run/local_run.h"
#include "run/output_files.h"

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

const std::map<std::string, RankExchange> kExchanges{
    {"auto", RankExchange::automatic}, {"near", RankExchange::near}, {"all", RankExchange::all}};

/// @param limit_s simulated time at which the run ends, if not before
std::string progressText(const LocalRun& run, double limit_s, double wall_s) {
  const State& state = run.environment().state();
  const auto active = std::count(state.activity.begin(), state.activity.end(), Activity::active);
  const double sim_s = state.time.seconds();
  return "simulated " + fixed(sim_s, 1) + " s, " +
         withCommas(static_cast<std::uint64_t>(sim_s / std::max(1e-9, wall_s))) + " times real time, " +
         std::to_string(active) + " of " + std::to_string(state.activity.size()) + " robots active" +
         commaRemainingTime(wall_s, sim_s, limit_s) + " at most (Ctrl-C ends the run)";
}

/// Sleeps until a time, in short intervals, because an interrupt does not wake it. @return false when interrupted
bool waitUntil(std::chrono::time_point<Clock, Seconds> then, const Interrupt& interrupt) {
  constexpr Seconds kNap(0.05);
  while (Clock::now() < then && !interrupt.isRequested()) {
    std::this_thread::sleep_for(std::min<Seconds>(kNap, then - Clock::now()));
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
    if (speed > 0 && !waitUntil(start + Seconds(now.seconds() / speed), interrupt)) {
      return EndedBy::interrupt;
    }
    run.step(observe);
    if (progress.due()) {
      progress.show(progressText(run, arguments.time_s, secondsSince(start)));
    }
  }
  return endedByItself(run);
}

/// The summary of a run that writes no files.
class SummaryOnly final : public RunFiles {
 public:
  SummaryOnly(const RunArguments& arguments, const LocalRun& run) : arguments_(arguments), run_(run) {}

  void observe() override {}
  void keep() override {}
  void finish(double wall_s, EndedBy ended_by) override {
    RunSummary summary = summaryOf(arguments_, run_, ended_by);
    summary.wall_s = wall_s;
    printSummary(summary, arguments_);
    std::cout.flush();
  }

 private:
  const RunArguments& arguments_;
  const LocalRun& run_;
};

using MakeRunFiles = decltype(&robosimMakeRunFiles);

/// To be called before the world is built, because it throws if this installation cannot write files.
/// @returns null if the run writes none
MakeRunFiles loadRunFiles(const LocalRunArguments& arguments) {
  return arguments.writesFiles() ? programFunction<MakeRunFiles>("robosimMakeRunFiles") : nullptr;
}

/// @param make by loadRunFiles() @param source of the world; nullopt if nothing is recorded
std::unique_ptr<RunFiles> makeRunFiles(MakeRunFiles make, const LocalRunArguments& arguments, const LocalRun& run,
                                       const std::optional<WorldSource>& source) {
  if (!make) return std::make_unique<SummaryOnly>(arguments, run);
  return std::unique_ptr<RunFiles>(make(arguments, run, source ? &*source : nullptr));
}

void checkArguments(const LocalRunArguments& arguments) {
  checkRunArguments(arguments);
  refuseSameFile({{"WORLD", arguments.world},
                  {"--record", arguments.record},
                  {"--picture", arguments.picture},
                  {"--csv", arguments.csv},
                  {"--npz", arguments.npz}});
}

/// @param source kept for the recording's note
LoadedWorld loadedWorld(const LocalRunArguments& arguments, std::optional<WorldSource>& source) {
  if (arguments.isRecorded() || !arguments.changes.isNone()) source = readRunSource(arguments);
  return source ? loadWorldToRun(*source, arguments.run.controller)
                : loadWorldToRun(arguments.world, arguments.run.controller, arguments.run.environment.seed);
}

constexpr const char* kInterrupted = "interrupted; all outputs cover the steps before";

/// @param window of --view, --foxglove or --ros2; null: none
void runWorld(const LocalRunArguments& arguments, const RunWindow& window, double window_speed) {
  std::optional<Interrupt> interrupt(std::in_place);
  checkArguments(arguments);
  const MakeRunFiles make_files = loadRunFiles(arguments);
  std::optional<WorldSource> source;
  LoadedWorld world = loadedWorld(arguments, source);
  RunOptions options = arguments.run;
  // Rendering takes most of the time of a run with cameras. Clients of a served run may request pictures at any time.
  const bool are_all_read = arguments.isRecorded() || readPictures(options.observers);
  options.takes_pictures = are_all_read || window || needPictures(world.fleet, options.controller);
  options.pictures_on_request = !are_all_read;
  options.check_added = [fault = whyNoAdditions(arguments)](const FleetRobot&) { return fault; };
  LocalRun run(std::move(world), options);
  const auto files = makeRunFiles(make_files, arguments, run, source);
  const ObserveStep observe = [&] { files->observe(); };
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
    files->keep();
    throw;
  }
  files->finish(secondsSince(start), ended_by);
  if (ended_by == EndedBy::interrupt) throw Interrupted(kInterrupted);
}

/// What has taken how long on each rank, for developers.
void logTimes(const std::vector<DistributedRun::Measured>& ranks) {
  constexpr std::array<const char*, DistributedRun::kParts> kNames{"controllers",     "commands", "clips", "judgements",
                                                                   "moves and index", "sensors",  "rest",  "waiting"};
  for (std::size_t rank = 0; rank < ranks.size(); ++rank) {
    const auto& measured = ranks[rank];
    const double steps = std::max<double>(1, static_cast<double>(measured.steps));
    std::string text = "rank " + std::to_string(rank) + ", ms per step:";
    for (std::size_t i = 0; i < kNames.size(); ++i)
      text += std::string(i == 0 ? " " : ", ") + kNames[i] + " " + fixed(measured.time_s[i] / steps * 1e3, 3) +
              " (processor " + fixed(measured.processor_s[i] / steps * 1e3, 3) + ")";
    const auto per_step = [&](std::uint64_t number) { return fixed(static_cast<double>(number) / steps, 1); };
    logDebug("run", text + "; per step sent " + per_step(measured.bytes_sent) + " and received " +
                        per_step(measured.bytes_received) + " bytes, moved " + per_step(measured.robots_moved) +
                        " robots; memory " + withCommas(measured.memory_max_bytes >> 20) + " MiB");
  }
}

/// The same on several ranks. Rank 0 writes the files, and prints.
void runOnRanks(const LocalRunArguments& arguments, RankGroup& group) {
  const Interrupt interrupt;
  std::optional<WorldSource> source;
  LoadedWorld world;
  MakeRunFiles make_files = nullptr;
  agree(group, [&] {
    checkArguments(arguments);
    if (group.isFirst()) make_files = loadRunFiles(arguments);
    world = loadedWorld(arguments, source);
  });
  RunOptions options = arguments.run;
  options.takes_pictures = arguments.isRecorded() || needPictures(world.fleet, options.controller, options.observers);
  DistributedRun run(group, std::move(world), options,
                     {.first_needs_readings = arguments.isRecorded() || !arguments.run.observers.empty(),
                      .balance_steps = arguments.balance_steps,
                      .first_needs_poses = !arguments.picture.empty(),
                      .exchange = kExchanges.at(arguments.exchange)});
  if (group.isFirst()) logDebug("run", run.exchangeText());
  std::unique_ptr<RunFiles> files;
  agree(group, [&] {
    if (group.isFirst()) files = makeRunFiles(make_files, arguments, run.run(), source);
  });
  // A failure is shared in the next step.
  std::exception_ptr failure;
  const auto observe = [&] {
    try {
      if (files) files->observe();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  const double speed = speedNumber(arguments.speed);
  const auto start = Clock::now();
  EndedBy ended_by = EndedBy::all_halted;
  try {
    observe();
    while (true) {
      const SimTime now = run.run().environment().time();
      if (run.isOver()) {
        ended_by = endedByItself(run.run());
        break;
      }
      if (run.isEndRequested() || arguments.timeIsUp(now)) {
        ended_by = run.isEndRequested() ? EndedBy::interrupt : EndedBy::time_limit;
        break;
      }
      if (speed > 0) waitUntil(start + Seconds(now.seconds() / speed), interrupt);
      run.step(interrupt.isRequested(), failure, observe);
    }
    run.finish(failure);
  } catch (const RecordingError&) {
    throw;
  } catch (...) {
    if (files) files->keep();
    throw;
  }
  agree(group, [&] {
    if (files) files->finish(secondsSince(start), ended_by);
  });
  logTimes(run.measured());
  if (ended_by != EndedBy::interrupt) return;
  setFailureShared();
  throw Interrupted(kInterrupted);
}

}  // namespace

void addRunCommand(CLI::App& program, const RunWindow& window, const RunServer& server) {
  // Each part has it; the error for an unknown option looks into all of them.
  const auto is_run = [](const CLI::App* one) { return one->get_name() == "run"; };
  if (!program.get_subcommands(is_run).empty()) return;
  auto* command = addSubcommand(program, "run");
  auto arguments = std::make_shared<LocalRunArguments>();
  addRunArguments(*command, *arguments);
  command
      ->add_option("--csv", arguments->csv,
                   "write all values as comma-separated values, one row per robot and step, as 'robosim export' does")
      ->type_name("FILE")
      ->check(fileName())
      ->group(kRecordingGroup);
  command->add_option("--npz", arguments->npz, "the same as NumPy's arrays, for each robot and sensor")
      ->type_name("FILE")
      ->check(fileName())
      ->group(kRecordingGroup);
  constexpr const char* kRanks = "mpirun with several processes";
  const auto has_ranks = [] { return rankGroup().size() > 1; };
  dependsOn(command
                ->add_option("--balance", arguments->balance_steps,
                             "divide moves and sensors again by the processes' times after every N steps; 0: never")
                ->type_name("N")
                ->capture_default_str()
                ->group(kRunGroup),
            kRanks, has_ranks);
  dependsOn(command
                ->add_option("--exchange", arguments->exchange,
                             "whether each process knows all robots, or only those near its own; auto: those near its "
                             "own if that is possible and spares work")
                ->check(CLI::IsMember({"auto", "near", "all"}))
                ->capture_default_str()
                ->group(kRunGroup),
            kRanks, has_ranks);
  auto has_view = std::make_shared<bool>(false);
  auto* const view =
      command
          ->add_flag(
              std::string(kViewOption), *has_view,
              "show the run in a window, in real time unless --speed is given; closing the window ends the run, and "
              "the window stays open after the run has ended; keys as for 'robosim view'")
          ->group(kRunGroup);
  auto live = std::make_shared<LiveArguments>();
  command
      ->add_option(std::string(kFoxgloveOption), live->foxglove,
                   "serve the topics of ROS 2 to Foxglove on this machine, in real time unless --speed is given; as "
                   "'robosim serve --foxglove' (doc/ros2.md)")
      ->type_name("PORT")
      ->excludes(view)
      ->group(kRunGroup);
  command
      ->add_option(std::string(kWebOption), live->web,
                   "show the run on a page in browsers of this machine, in real time unless --speed is given; as "
                   "'robosim serve --web' (doc/run_page.md); usually 8081")
      ->type_name("PORT")
      ->excludes(view)
      ->group(kRunGroup);
  addRos2Options(*command, live->ros2, kRunGroup, false);
  command->get_option(std::string(kRos2Option))->excludes(view);
  command->footer(controllersHelp);
  command->callback([arguments, window, server, command, has_view, live] {
    const double speed = command->count("--speed") > 0 ? speedNumber(arguments->speed) : 1;
    if (!live->isNone()) {
      if (!server) {
        throw ConfigError(
            "--foxglove, --ros2 and --web are features of the command 'robosim run', which starts robosim-net");
      }
      const RunWindow serve = [&](auto& run, const auto& of_run, double run_speed, const auto& observe) {
        return server(run, of_run, *live, run_speed, observe);
      };
      return runWorld(*arguments, serve, speed);
    }
    if (!*has_view && rankGroup().size() > 1) return runOnRanks(*arguments, rankGroup());
    if (!*has_view) return runWorld(*arguments, {}, 0);
    if (!window) throw ConfigError("--view: is a feature of the command 'robosim run', which starts robosim-view");
    runWorld(*arguments, window, speed);
  });
}

void addRun(CLI::App& program) { addRunCommand(program, {}, {}); }

}  // namespace robosim
