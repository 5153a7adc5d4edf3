#include "robosim/run_outputs.h"

#include <iostream>

#include <CLI/CLI.hpp>

#include "maze/controllers.h"
#include "rendering/plan.h"
#include "robosim/arguments.h"
#include "robosim/text.h"

namespace robosim {
namespace {

std::unique_ptr<RawlogWriter> openRecording(const RunArguments& arguments, const Environment& environment,
                                            const RunNote& note) {
  if (arguments.record.empty()) return nullptr;
  std::vector<RobotInfo> robots;
  for (const auto& robot : environment.fleet().robots) robots.push_back(robot.info);
  const auto format = arguments.rawlog_format == "sf" ? RawlogFormat::sensory_frames : RawlogFormat::observations;
  const auto images = arguments.record_images == "external" ? RawlogImages::external : RawlogImages::embedded;
  return std::make_unique<RawlogWriter>(arguments.record, robots, format, images, note.text());
}

/// The picture comes last, so that a disk that is full by now costs nobody the summary; and it was no bad input.
void draw(const std::string& picture, const Environment& environment, const Tracks& tracks) {
  try {
    writePlan(picture, environment.world(), environment.fleet(), tracks.points(), environment.state().world_from_robot);
  } catch (const ConfigError& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace

void RunArguments::check() const {
  speedNumber(speed);
  refuseSameFile({{"WORLD", world}, {"--record", record}, {"--picture", picture}});
}

bool RunArguments::timeIsUp(const SimTime& now) const {
  // Half a step of grace: the limit is meant, not its last digit.
  return now.seconds() + now.period_s / 2 > time_s;
}

void addRunArguments(CLI::App& command, RunArguments& a) {
  command.add_option("WORLD", a.world, "world file")->type_name("FILE")->required();
  command.add_option("--record", a.record, "keep the run as an MRPT rawlog in this file")
      ->type_name("FILE")
      ->check(fileName());
  command
      .add_option("--rawlog-format", a.rawlog_format,
                  "obs: observations; sf: pairs of action and sensory frame, one file a robot")
      ->check(CLI::IsMember({"obs", "sf"}))
      ->capture_default_str();
  command
      .add_option("--record-images", a.record_images,
                  "cameras' pictures: embedded in the rawlog, or external, as JPEG files in STEM_Images beside it")
      ->check(CLI::IsMember({"embedded", "external"}))
      ->capture_default_str();
  command.add_option("--seed", a.run.environment.seed, "of everything that is left to chance")
      ->check(seedNumber())
      ->capture_default_str();
  command
      .add_option("--time", a.time_s,
                  "simulated seconds after which the run ends; it ends sooner when all robots have halted")
      ->check(numberIn(1e-3, 1e9))
      ->type_name("SECONDS")
      ->capture_default_str();
  command.add_option("--step", a.run.environment.period_s, "length of a time step, seconds")
      ->check(numberIn(0.001, 1))
      ->type_name("SECONDS")
      ->capture_default_str();
  command.add_option("--threads", a.run.environment.threads, "the run is the same for any number")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_option("--speed", a.speed, "simulated seconds per second: a number (1 is real time) or max")
      ->type_name("X|max")
      ->capture_default_str();
  command.add_option("--controller", a.run.controller, "for all robots, in place of what the world names")
      ->check(CLI::IsMember(controllerNames()));
  command.add_option("--picture", a.picture, "draw the world from above with every robot's path to this PNG file")
      ->type_name("FILE")
      ->check(fileName());
  command.add_flag("--json", a.json, "print the summary as one JSON object");
}

std::string controllersHelp() {
  std::string text = "Controllers:\n";
  Rows rows;
  for (const auto& type : controllerTypes()) rows.push_back({std::string("  ") + type.name, type.help});
  return text + listing(rows);
}

RunOutputs::RunOutputs(const RunArguments& arguments, const Environment& environment, RunNote note)
    : arguments_(arguments), note_(std::move(note)), recording_(openRecording(arguments, environment, note_)) {
  if (arguments.picture.empty()) return;
  checkPlanFile(arguments.picture);
  tracks_ = std::make_unique<Tracks>(environment.robotCount());
}

void RunOutputs::observe(const Environment& environment) {
  const State& state = environment.state();
  if (recording_) recording_->write(state.readings, state.world_from_robot, environment.commands());
  if (tracks_) tracks_->add(state.world_from_robot);
}

void RunOutputs::keep(const Environment& environment) {
  if (recording_ && environment.time().step > 0) recording_->close();
}

void RunOutputs::finish(const LocalRun& run, double wall_s, EndedBy ended_by, std::optional<std::uint64_t> late) {
  RunSummary summary = RunSummary::of(run);
  summary.wall_s = wall_s;
  summary.world = arguments_.world;
  summary.seed = arguments_.run.environment.seed;
  summary.ended_by = ended_by;
  summary.late = late;
  if (recording_) {
    note_.outcome = summary.json();
    // The same run is the same file, however long it took.
    for (const char* of_the_clock : {"wall_s", "real_time_factor"}) note_.outcome.erase(of_the_clock);
    recording_->close(note_.text());
  }
  if (arguments_.json) {
    std::cout << summary.json().dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  } else {
    std::cout << summary.text();
    if (recording_) {
      for (const auto& file : recording_->files()) std::cout << "rawlog    " << file.string() << '\n';
    }
    if (tracks_) std::cout << "picture   " << arguments_.picture << std::endl;
  }
  if (tracks_) draw(arguments_.picture, run.environment(), *tracks_);
}

}  // namespace robosim
