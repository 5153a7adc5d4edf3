#include "outputs/run_outputs.h"

#include <exception>
#include <iostream>

#include "base/printable_text.h"
#include "rendering/plan.h"
#include "run/json_text.h"
#include "run/output_files.h"

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

/// nullopt for absent robots.
std::vector<std::optional<mrpt::math::TPose2D>> presentPoses(const State& state) {
  std::vector<std::optional<mrpt::math::TPose2D>> poses(state.world_from_robot.begin(), state.world_from_robot.end());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (state.activity[i] == Activity::absent) poses[i].reset();
  }
  return poses;
}

/// Thrown when the picture cannot be written at the end; not bad input, because the path was checked at the start.
void draw(const std::string& picture, const Environment& environment, const Tracks& tracks) {
  try {
    writePlan(picture, environment.world(), environment.fleet(), tracks.points(), presentPoses(environment.state()));
  } catch (const ConfigError& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace

WorldSource sourceOf(const RunArguments& arguments) {
  WorldSource source = readWorldSource(arguments.world);
  source.seed = arguments.run.environment.seed;
  return withChanges(source, arguments.changes, arguments.run.environment.seed);
}

bool RunArguments::timeIsUp(const SimTime& now) const {
  // Tolerance of half a step against rounding of the limit.
  return now.seconds() + now.period_s / 2 > time_s;
}

RunOutputs::RunOutputs(const RunArguments& arguments, const Environment& environment, RunNote note)
    : arguments_(arguments), note_(std::move(note)) {
  const auto inputs = inputFilesOf(arguments.world, environment.world());
  refuseOverwriting(inputs, {arguments.record, arguments.picture});
  recording_ = openRecording(arguments, environment, note_);
  if (recording_) refuseOverwriting(inputs, recording_->files());  // format "sf" has a file per robot
  if (arguments.picture.empty()) return;
  checkPlanFile(arguments.picture);
  tracks_ = std::make_unique<Tracks>(environment.robotCount());
}

void RunOutputs::observe(const Environment& environment) {
  const State& state = environment.state();
  if (recording_) recording_->write(state.readings, state.world_from_robot, state.commands);
  if (tracks_) tracks_->add(state.world_from_robot, state.activity);
}

void RunOutputs::keep(const Environment& environment) {
  if (recording_ && environment.time().step > 0) recording_->close();
}

void RunOutputs::finish(const LocalRun& run, double wall_s, EndedBy ended_by, std::optional<std::uint64_t> late,
                        const std::optional<RunReport>& report) {
  RunSummary summary = RunSummary::of(run);
  summary.wall_s = wall_s;
  summary.world = arguments_.world;
  summary.seed = arguments_.run.environment.seed;
  summary.ended_by = ended_by;
  summary.late = late;
  summary.report = report;
  summary.depends_on_seed |= arguments_.changes.has_random_starts || arguments_.changes.random_robots > 0;
  summary.depends_on_seed |= run.environment().world().origin.is_scattered;
  if (recording_) {
    note_.outcome = summary.json();
    // The file of a repeated run is identical regardless of its duration.
    for (const char* of_the_clock : {"wall_s", "real_time_factor"}) note_.outcome.erase(of_the_clock);
    recording_->close(note_.text());
  }
  std::exception_ptr failure;
  try {
    if (tracks_) draw(arguments_.picture, run.environment(), *tracks_);
  } catch (const std::exception&) {
    failure = std::current_exception();  // print the summary even if the disk is full
  }
  if (arguments_.json) {
    std::cout << jsonText(summary.json()) << std::endl;
  } else {
    std::cout << summary.text();
    if (recording_) {
      for (const auto& file : recording_->files()) std::cout << "rawlog    " << printableText(file.string()) << '\n';
    }
    if (tracks_ && !failure) std::cout << "picture   " << printableText(arguments_.picture) << std::endl;
  }
  std::cout.flush();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace robosim
