#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "maze/controllers.h"
#include "recording/rawlog_writer.h"
#include "recording/recording_error.h"
#include "rendering/plan.h"
#include "robosim/arguments.h"
#include "robosim/interrupt.h"
#include "robosim/local_run.h"
#include "robosim/progress.h"
#include "robosim/run_summary.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"
#include "robosim/tracks.h"

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string world;
  RunOptions run;
  double time_s = 1800;
  std::string speed = "max";
  std::string record;
  std::string rawlog_format = "obs";
  std::string picture;
  bool json = false;
};

/// How many simulated seconds a second may hold; 0 for as many as it can.
double speedOf(const std::string& text) {
  if (text == "max") return 0;
  char* end = nullptr;
  const double speed = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(speed >= 0.001 && speed <= 1e6)) {
    throw ConfigError("--speed " + text + ": must be 'max' or a number in [0.001, 1000000]; 1 is real time");
  }
  return speed;
}

std::unique_ptr<RawlogWriter> openRecording(const Arguments& arguments, const Environment& environment) {
  if (arguments.record.empty()) return nullptr;
  std::vector<RobotInfo> robots;
  for (const auto& robot : environment.fleet().robots) robots.push_back(robot.info);
  const auto format = arguments.rawlog_format == "sf" ? RawlogFormat::sensory_frames : RawlogFormat::observations;
  return std::make_unique<RawlogWriter>(arguments.record, robots, format);
}

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

EndedBy drive(LocalRun& run, const Arguments& arguments, const Interrupt& interrupt, RawlogWriter* recording,
              Tracks* tracks) {
  const double speed = speedOf(arguments.speed);
  const auto observe = [&] {
    const State& state = run.environment().state();
    if (recording) recording->write(state.readings, state.world_from_robot);
    if (tracks) tracks->add(state.world_from_robot);
  };
  Progress progress;
  const auto start = Clock::now();
  observe();
  while (!run.gold().all_halted_s) {
    const double sim_s = run.environment().time().seconds();
    if (interrupt.asked()) return EndedBy::interrupt;
    // Half a step of grace: the limit is meant, not its last digit.
    if (sim_s + run.environment().time().period_s / 2 > arguments.time_s) return EndedBy::time_limit;
    if (speed > 0 && !waitUntil(start + std::chrono::duration<double>(sim_s / speed), interrupt)) {
      return EndedBy::interrupt;
    }
    run.step();
    observe();
    if (progress.due()) {
      progress.show(progressText(run, std::chrono::duration<double>(Clock::now() - start).count()));
    }
  }
  return EndedBy::all_halted;
}

/// The picture comes last, so that a disk that is full by now costs nobody the summary; and it was no bad input.
void draw(const std::string& picture, const Environment& environment, const Tracks& tracks) {
  try {
    writePlan(picture, environment.world(), environment.fleet(), tracks.points(), environment.state().world_from_robot);
  } catch (const ConfigError& error) {
    throw std::runtime_error(error.what());
  }
}

void runWorld(const Arguments& arguments) {
  const Interrupt interrupt;
  speedOf(arguments.speed);  // a slip in an argument is told before the work begins
  refuseSameFile({{"WORLD", arguments.world}, {"--record", arguments.record}, {"--picture", arguments.picture}});
  LocalRun run(loadWorldToRun(arguments.world, arguments.run.controller), arguments.run);
  auto recording = openRecording(arguments, run.environment());
  std::unique_ptr<Tracks> tracks;
  if (!arguments.picture.empty()) {
    checkPlanFile(arguments.picture);
    tracks = std::make_unique<Tracks>(run.environment().robotCount());
  }

  const auto start = Clock::now();
  EndedBy ended_by = EndedBy::all_halted;
  try {
    ended_by = drive(run, arguments, interrupt, recording.get(), tracks.get());
  } catch (const RecordingError&) {
    throw;
  } catch (...) {
    // What there is of a run that failed is what one wants to look at; of one that never began there is nothing.
    if (recording && run.environment().time().step > 0) recording->close();
    throw;
  }
  if (recording) recording->close();
  RunSummary summary = RunSummary::of(run);
  summary.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  summary.world = arguments.world;
  summary.seed = arguments.run.environment.seed;
  summary.ended_by = ended_by;
  if (arguments.json) {
    std::cout << summary.json().dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  } else {
    std::cout << summary.text();
    if (recording) {
      for (const auto& file : recording->files()) std::cout << "rawlog    " << file.string() << '\n';
    }
    if (tracks) std::cout << "picture   " << arguments.picture << std::endl;
  }
  if (tracks) draw(arguments.picture, run.environment(), *tracks);
}

std::string controllersHelp() {
  std::string text = "Controllers:\n";
  Rows rows;
  for (const auto& type : controllerTypes()) rows.push_back({std::string("  ") + type.name, type.help});
  return text + listing(rows);
}

}  // namespace

void addRun(CLI::App& program) {
  auto* command = program.add_subcommand("run", "Run a world in this process, as fast as it can");
  auto a = std::make_shared<Arguments>();
  auto& environment = a->run.environment;
  command->add_option("WORLD", a->world, "world file")->type_name("FILE")->required();
  command->add_option("--record", a->record, "keep the run as an MRPT rawlog in this file")
      ->type_name("FILE")
      ->check(fileName());
  command
      ->add_option("--rawlog-format", a->rawlog_format,
                   "obs: observations; sf: pairs of action and sensory frame, one file a robot")
      ->check(CLI::IsMember({"obs", "sf"}))
      ->capture_default_str();
  command->add_option("--seed", environment.seed, "of everything that is left to chance")
      ->check(seedNumber())
      ->capture_default_str();
  command
      ->add_option("--time", a->time_s,
                   "simulated seconds after which the run ends; it ends sooner when all robots have halted")
      ->check(numberIn(1e-3, 1e9))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_option("--step", environment.period_s, "length of a time step, seconds")
      ->check(numberIn(0.001, 1))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_option("--threads", environment.threads, "the run is the same for any number")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--speed", a->speed, "simulated seconds per second: a number (1 is real time) or max")
      ->type_name("X|max")
      ->capture_default_str();
  command->add_option("--controller", a->run.controller, "for all robots, in place of what the world names")
      ->check(CLI::IsMember(controllerNames()));
  command->add_option("--picture", a->picture, "draw the world from above with every robot's path to this PNG file")
      ->type_name("FILE")
      ->check(fileName());
  command->add_flag("--json", a->json, "print the summary as one JSON object");
  command->footer(controllersHelp());
  command->callback([a] { runWorld(*a); });
}

}  // namespace robosim
