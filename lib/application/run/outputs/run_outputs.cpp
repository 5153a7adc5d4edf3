#include "run/outputs/run_outputs.h"

#include <exception>
#include <iostream>
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "base/printable_text.h"
#include "hardware/command.h"
#include "rendering/plan.h"
#include "run/json_text.h"
#include "run/output_files.h"

namespace robosim {

/// Sampled path of every robot of a run: a point every few centimetres.
class RunOutputs::Tracks {
 public:
  explicit Tracks(std::size_t robots) : points_(robots) {}

  /// The path of an absent robot begins again when it comes back.
  void add(std::span<const mrpt::math::TPose2D> world_from_robot, std::span<const Activity> activity) {
    constexpr double kSpacing_m = 0.05;
    points_.resize(world_from_robot.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (activity[i] == Activity::absent) {
        points_[i].clear();
        continue;
      }
      const mrpt::math::TPoint2D now(world_from_robot[i].x, world_from_robot[i].y);
      if (points_[i].empty() || (now - points_[i].back()).norm() >= kSpacing_m) points_[i].push_back(now);
    }
  }

  /// By robot, in order of time.
  const std::vector<std::vector<mrpt::math::TPoint2D>>& points() const { return points_; }

 private:
  std::vector<std::vector<mrpt::math::TPoint2D>> points_;
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

/// Thrown when the picture cannot be written at the end; not bad input, because the path was checked at the start.
void draw(const std::string& picture, const Environment& environment,
          const std::vector<std::vector<mrpt::math::TPoint2D>>& tracks) {
  try {
    writePlan(picture, environment.presentWorld(), environment.fleet(), tracks, presentPoses(environment.state()));
  } catch (const ConfigError& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace

WorldSource readRunSource(const RunArguments& arguments) {
  WorldSource source = readWorldSource(arguments.world);
  source.seed = arguments.run.environment.seed;
  return withChanges(source, arguments.changes, arguments.run.environment.seed);
}

std::string whyNoAdditions(const RunArguments& arguments) {
  if (arguments.record.empty() || arguments.rawlog_format != "sf") return {};
  return "robots cannot be added to a run whose recording has a file for each robot; record observations "
         "(--rawlog-format obs)";
}

bool RunArguments::timeIsUp(const SimTime& now) const {
  // Tolerance of half a step against rounding of the limit.
  return now.seconds() + now.period_s / 2 > time_s;
}

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
            .images = arguments.record_images == "external" ? RawlogImages::external : RawlogImages::embedded},
        std::move(robots), std::move(note), environment.model());
    if (!arguments.is_recorded_on_request) recording_->open();
    refuseOverwriting(inputs, recording_->files());  // format "sf" has a file per robot
  }
  if (arguments.picture.empty()) return;
  checkPlanFile(arguments.picture);
  tracks_ = std::make_unique<Tracks>(environment.robotCount());
}

RunOutputs::~RunOutputs() = default;

void RunOutputs::observe(const Environment& environment) {
  const State& state = environment.state();
  if (recording_) {
    recording_->follow(environment.fleet());
    recording_->write(state);
  }
  if (tracks_) tracks_->add(state.world_from_robot, state.activity);
}

void RunOutputs::setRecording(bool on, const LocalRun& run) {
  if (!recording_) throw ConfigError("the run is not recorded: robosim serve was started without --record");
  if (on == recording_->isOn()) return;
  if (on) {
    recording_->follow(run.environment().fleet());
    recording_->openNext(run.environment().state());
  } else {
    recording_->close(run.environment().state(), summaryOf(run, EndedBy::recording_stopped));
  }
}

void RunOutputs::keep(const Environment& environment) {
  if (recording_ && environment.time().step > 0) recording_->keep();
}

RunSummary RunOutputs::summaryOf(const LocalRun& run, EndedBy ended_by) const {
  RunSummary summary = RunSummary::of(run);
  summary.world = arguments_.world;
  summary.seed = arguments_.run.environment.seed;
  summary.ended_by = ended_by;
  summary.depends_on_seed |= arguments_.changes.has_random_starts || arguments_.changes.random_robots > 0;
  summary.depends_on_seed |= run.environment().world().origin.is_scattered;
  return summary;
}

void RunOutputs::finish(const LocalRun& run, double wall_s, EndedBy ended_by, std::optional<std::uint64_t> late,
                        const std::optional<RunReport>& report) {
  RunSummary summary = summaryOf(run, ended_by);
  summary.wall_s = wall_s;
  summary.late = late;
  summary.report = report;
  // The summary is printed even if the disk is full.
  std::exception_ptr failure;
  bool is_drawn = false;
  try {
    if (recording_) recording_->finish(run.environment().state(), summary);
    if (tracks_) draw(arguments_.picture, run.environment(), tracks_->points());
    is_drawn = tracks_ != nullptr;
  } catch (const std::exception&) {
    failure = std::current_exception();
  }
  if (arguments_.json) {
    std::cout << jsonText(summary.json()) << std::endl;
  } else {
    std::cout << summary.text();
    if (recording_) {
      for (const auto& file : recording_->files()) {
        std::cout << (isMcapName(file) ? "mcap      " : "rawlog    ") << printableText(file.string()) << '\n';
      }
    }
    if (is_drawn) std::cout << "picture   " << printableText(arguments_.picture) << std::endl;
  }
  std::cout.flush();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace robosim
