#include "run/outputs/run_outputs.h"

#include <exception>
#include <iostream>
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "base/file_kind.h"
#include "base/printable_text.h"
#include "hardware/command.h"
#include "rendering/plan.h"
#include "run/output_files.h"

namespace robosim {

/// Sampled path of every robot of a run: a point every few centimetres.
class RunOutputs::Tracks {
 public:
  explicit Tracks(std::size_t robots) : points_(robots) {}

  /// The path of an absent robot begins again when it comes back.
  void add(double time_s, std::span<const mrpt::math::TPose2D> world_from_robot, std::span<const Activity> activity) {
    constexpr double kSpacing_m = 0.05;
    points_.resize(world_from_robot.size());
    times_s_.resize(world_from_robot.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (activity[i] == Activity::absent) {
        points_[i].clear();
        times_s_[i].clear();
        continue;
      }
      const mrpt::math::TPoint2D now(world_from_robot[i].x, world_from_robot[i].y);
      if (!points_[i].empty() && (now - points_[i].back()).norm() < kSpacing_m) continue;
      points_[i].push_back(now);
      times_s_[i].push_back(time_s);
    }
  }

  /// By robot, in order of time.
  const std::vector<std::vector<mrpt::math::TPoint2D>>& points() const { return points_; }
  const std::vector<std::vector<double>>& times() const { return times_s_; }

 private:
  std::vector<std::vector<mrpt::math::TPoint2D>> points_;
  std::vector<std::vector<double>> times_s_;
};

namespace {

/// nullopt for absent robots.
std::vector<std::optional<mrpt::math::TPose2D>> presentPoses(const State& state) {
  std::vector<std::optional<mrpt::math::TPose2D>> poses(state.world_from_robot.begin(), state.world_from_robot.end());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (state.activity[i] == Activity::absent) poses[i].reset();
  }
  return poses;
}

/// Throws when the picture cannot be written at the end; not bad input, because the path was checked at the start.
/// @param drawn the paths
void draw(const RunArguments& arguments, const Environment& environment, DrawnRun drawn) {
  try {
    ViewLayers layers = arguments.layers;
    layers.only = arguments.only.flagsIn(environment.fleet(), RobotSelection::Unmatched::ignored);
    const World world = environment.presentWorld();
    drawn.world_from_robot = presentPoses(environment.state());
    applyLayers(drawn, layers, world, environment.fleet());
    writePlan(arguments.picture, world, environment.fleet(), drawn);
  } catch (const ConfigError& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace

RunOutputs::RunOutputs(const RunArguments& arguments, const Environment& environment, RunNote note)
    : arguments_(arguments) {
  const auto inputs = listInputFiles(arguments.world, environment.world());
  refuseOverwriting(inputs, {arguments.record, arguments.picture});
  if (!arguments.record.empty()) {
    std::vector<RobotInfo> robots;
    for (const auto& robot : environment.fleet().robots) robots.push_back(robot.info);
    recording_ = std::make_unique<RunRecording>(
        RecordingOptions{
            .file = arguments.record,
            .format = arguments.rawlog_format == "sf" ? RawlogFormat::sensory_frames : RawlogFormat::observations,
            .images = arguments.record_images == "external" ? RawlogImages::external : RawlogImages::embedded,
            .distribution = arguments.distribution},
        std::move(robots), std::move(note), environment.model());
    if (!arguments.is_recorded_on_request) recording_->open();
    refuseOverwriting(inputs, recording_->files());  // format "sf" has a file per robot
  }
  if (arguments.picture.empty()) return;
  checkPlanFile(arguments.picture);
  arguments.only.flagsIn(environment.fleet(), RobotSelection::Unmatched::refused);
  tracks_ = std::make_unique<Tracks>(environment.robotCount());
}

RunOutputs::~RunOutputs() = default;

void RunOutputs::observe(const Environment& environment) {
  const State& state = environment.state();
  if (recording_) {
    recording_->follow(environment.fleet());
    recording_->write(state);
  }
  if (tracks_) tracks_->add(state.time.seconds(), state.world_from_robot, state.activity);
}

void RunOutputs::setRecording(bool on, const LocalRun& run) {
  if (!recording_) throw ConfigError("the run is not recorded: robosim serve was started without --record");
  if (on == recording_->isOn()) return;
  if (on) {
    recording_->follow(run.environment().fleet());
    recording_->openNext(run.environment().state());
  } else {
    recording_->close(run.environment().state(), summaryOf(arguments_, run, EndedBy::recording_stopped));
  }
}

void RunOutputs::keep(const Environment& environment) {
  if (recording_ && environment.time().step > 0) recording_->keep();
}

void RunOutputs::finish(const LocalRun& run, double wall_s, EndedBy ended_by, std::optional<std::uint64_t> late,
                        const std::optional<RunReport>& report) {
  RunSummary summary = summaryOf(arguments_, run, ended_by);
  summary.wall_s = wall_s;
  summary.late = late;
  summary.report = report;
  // The summary is printed even if the disk is full.
  std::exception_ptr failure;
  bool is_drawn = false;
  try {
    if (recording_) recording_->finish(run.environment().state(), summary);
    if (tracks_) {
      draw(arguments_, run.environment(), {.paths = tracks_->points(), .path_times_s = tracks_->times()});
    }
    is_drawn = tracks_ != nullptr;
  } catch (const std::exception&) {
    failure = std::current_exception();
  }
  printSummary(summary, arguments_);
  if (!arguments_.json && recording_) {
    for (const auto& file : recording_->files()) {
      std::cout << (isMcapName(file) ? "mcap      " : "rawlog    ") << printableText(file.string()) << '\n';
    }
  }
  if (!arguments_.json && is_drawn) std::cout << "picture   " << printableText(arguments_.picture) << std::endl;
  std::cout.flush();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace robosim
