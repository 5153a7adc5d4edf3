#include "serving/live_serving.h"

#include <algorithm>

namespace robosim {
namespace {

std::string ros2Line(const Ros2Options& options) {
  return "ROS 2: domain " + std::to_string(options.dds.domain) +
         (options.dds.isLocal() ? ", this machine only" : ", also other machines") +
         (options.may_drive ? "" : ", without driving");
}

}  // namespace

LiveServing::LiveServing(const LiveOptions& options) : drivers_(options.access, options.log) {
  if (options.foxglove) {
    foxglove_ = std::make_unique<FoxgloveServing>(*options.foxglove, drivers_);
    options.log(foxgloveLine(options.foxglove->server, foxglove_->port()));
  }
  if (options.ros2) {
    ros2_ = std::make_unique<Ros2Serving>(*options.ros2, drivers_);
    options.log(ros2Line(*options.ros2));
  }
  if (options.page) {
    page_ = std::make_unique<PageServing>(*options.page);
    options.log(livePageLine(options.page->server, page_->port()));
  }
}

void LiveServing::begin(LocalRun& run, const std::string& run_id, std::uint64_t seed,
                        const std::vector<std::string>& why_not_driven) {
  run_id_ = run_id;
  seed_ = seed;
  drivers_.begin(run, why_not_driven);
  if (foxglove_) foxglove_->begin(foxgloveRun(run.environment()));
  if (ros2_) ros2_->begin(run.environment());
  if (page_) page_->begin(run.environment(), run_id, seed);
}

FoxgloveRun LiveServing::foxgloveRun(const Environment& environment) const {
  return {.model = environment.model(), .state = environment.state(), .id = run_id_, .seed = seed_};
}

void LiveServing::addRobots(LocalRun& run, const std::vector<std::string>& why_not_driven) {
  drivers_.addRobots(run, why_not_driven);
  if (foxglove_) foxglove_->begin(foxgloveRun(run.environment()));
  if (ros2_) ros2_->addRobots();
  if (page_) page_->addRobots();
}

void LiveServing::poll(RunControl& control, const FoxgloveRecording& recording, bool is_over,
                       const Intervene& intervene) {
  if (foxglove_) foxglove_->poll(control, recording);
  if (ros2_) ros2_->poll(intervene);
  if (page_) page_->poll(control, is_over, intervene);
}

void LiveServing::stepped() {
  if (foxglove_) foxglove_->stepped();
  if (ros2_) ros2_->stepped();
  if (page_) page_->stepped();
}

std::vector<std::uint8_t> LiveServing::pictured() const {
  std::vector<std::uint8_t> all = foxglove_ ? foxglove_->pictured() : std::vector<std::uint8_t>();
  if (!ros2_) return all;
  const std::vector<std::uint8_t> of_ros2 = ros2_->pictured();
  all.resize(std::max(all.size(), of_ros2.size()));
  for (std::size_t i = 0; i < of_ros2.size(); ++i) all[i] |= of_ros2[i];
  return all;
}

}  // namespace robosim
