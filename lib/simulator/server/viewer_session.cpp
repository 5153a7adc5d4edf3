#include "server/viewer_session.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "hardware/picture_file.h"
#include "net/wire_error.h"
#include "wire/viewed_run.h"
#include "wire/world_wire.h"

namespace robosim {
namespace {

RobotSnapshot withoutReadings(const State& state, std::size_t i) {
  return {state.world_from_robot[i], state.laser_pan_rad[i], state.stalled[i] != 0,
          state.activity[i],         std::nullopt,           state.commands[i].led_color};
}

}  // namespace

/// Session of one viewer.
class ViewerSession::Stream final : public StreamSession<v1::FrameRequest, v1::Frame> {
 public:
  explicit Stream(ViewerSession& owner)
      : StreamSession(owner.serving_, {.right = Right::look, .log_kind = "refused viewers"}), owner_(owner) {}

  std::string logName() const override { return "viewer " + peer(); }

  /// Whether it has requested a frame that it has not received.
  bool isWaitingFor(const Environment& environment) const {
    return has_request && isIdle() &&
           (needs_world || step != environment.time().step || pose_changes != environment.poseChanges() ||
            sent_selection != selection);
  }

  void answered() {
    has_request = false;
    if (has_finished_requests_) end(grpc::Status::OK);
  }

  bool has_request = false;  ///< for a frame
  ReadingsSelection selection;
  bool needs_world = true;         ///< the next frame is complete
  std::uint64_t step = 0;          ///< of the last frame sent
  std::uint64_t pose_changes = 0;  ///< Environment::poseChanges() of that frame
  ChangedObjects sent_objects;
  ReadingsSelection sent_selection;        ///< of that frame
  std::vector<RobotSnapshot> sent_robots;  ///< last state sent, without readings
  SentSteps sent_steps;
  std::map<std::pair<std::size_t, std::size_t>, std::uint64_t>
      sent_pictures;  ///< step of the picture, by robot and sensor

 private:
  ReadPolicy received(const v1::FrameRequest& message) override {
    if (!isEstablished()) {
      checkProtocol(message.protocol());
      establish();
      owner_.streams_.push_back(std::static_pointer_cast<Stream>(shared_from_this()));
    }
    selection = decode(message, owner_.serving_.run_info->robot_names.size());
    has_request = has_request || !message.amends();
    owner_.serving_.wake_requested = true;
    return ReadPolicy::rate_limited;
  }
  /// Ends the call after the frames already requested.
  void readsDone() override {
    has_finished_requests_ = true;
    if (!has_request) end(grpc::Status::OK);
  }
  void left() override {
    std::erase_if(owner_.streams_, [&](const auto& stream) { return stream.get() == this; });
  }

  ViewerSession& owner_;
  bool has_finished_requests_ = false;
};

ViewerSession::ViewerSession(ServingState& serving) : serving_(serving) {}
ViewerSession::~ViewerSession() = default;

void ViewerSession::open(const CompletionQueueServer::ServiceQueues& queues) {
  serving_.serve(
      queues, [this] { return std::make_shared<Stream>(*this); },
      [this](auto... arguments) { RequestWatch(arguments...); });
}

void ViewerSession::reset() {
  camera_frames_.clear();
  for (const auto& stream : streams_) stream->needs_world = true;
}

void ViewerSession::publish() {
  const State& state = serving_.run_info->environment.state();
  std::set<std::uint32_t> watched;
  for (const auto& stream : streams_) watched.insert(stream->selection.of.begin(), stream->selection.of.end());
  camera_frames_.update(watched, state.readings);
  for (const auto& stream : streams_) {
    if (stream->isWaitingFor(serving_.run_info->environment)) send(*stream);
  }
}

void ViewerSession::addPictured(std::vector<std::uint8_t>& robots) const {
  for (const auto& stream : streams_) {
    for (const std::uint32_t robot : stream->selection.of) robots[robot] = 1;
  }
}

void ViewerSession::send(Stream& stream) {
  const RunInfo& run_info = *serving_.run_info;
  const State& state = run_info.environment.state();
  v1::Frame& frame = stream.draft();
  frame.Clear();
  if (stream.needs_world) {
    v1::FrameWorld& world = *frame.mutable_world();
    encode(run_info.source, *world.mutable_source());
    world.set_world_version(run_info.world_version);
    world.set_period_s(state.time.period_s);
    for (const AddRobot& robot : state.additions.list()) world.add_added_robots(changeText(robot));
    world.set_may_operate(serving_.access.check(stream.client(), Right::operate).ok());
  }
  frame.set_step(state.time.step);
  frame.set_time_s(state.time.seconds());
  if (state.winner()) frame.set_winner(run_info.robot_names[*state.winner()]);
  if (stream.needs_world) {
    stream.sent_steps.assign(run_info.robot_names.size(), std::nullopt);
    stream.sent_pictures.clear();
  }
  if (stream.needs_world ? state.objects.areChanged() : !state.objects.isSameList(stream.sent_objects)) {
    const auto& of_world = run_info.environment.world().objects;
    encode(state.objects, stream.needs_world ? of_world : stream.sent_objects.orThose(of_world), frame);
  }
  stream.sent_objects = state.objects;
  stream.sent_robots.resize(run_info.robot_names.size());
  for (std::size_t i = 0; i < stream.sent_robots.size(); ++i) {
    const RobotSnapshot robot = withoutReadings(state, i);
    if (robot == stream.sent_robots[i] && !stream.needs_world) continue;
    stream.sent_robots[i] = robot;
    encode(robot, i, *frame.add_robots());
  }
  const bool repeats_pictures = stream.sent_selection != stream.selection;
  stream.sent_selection = stream.selection;
  encode(state.readings, stream.sent_selection, stream.sent_steps, frame);
  addPictures(stream, frame, repeats_pictures);
  stream.needs_world = false;
  stream.step = state.time.step;
  stream.pose_changes = run_info.environment.poseChanges();
  stream.post();
  stream.answered();
}

void ViewerSession::addPictures(Stream& stream, v1::Frame& frame, bool repeats) const {
  for (auto& view : *frame.mutable_readings()) {
    if (!std::binary_search(stream.sent_selection.of.begin(), stream.sent_selection.of.end(), view.world_robot()))
      continue;
    for (int slot = 0; slot < view.readings().measurements_size(); ++slot) {
      const auto* picture = camera_frames_.find(view.world_robot(), static_cast<std::size_t>(slot));
      if (!picture) continue;
      const auto [sent, is_first] = stream.sent_pictures.try_emplace({view.world_robot(), slot}, picture->step);
      const bool is_new = is_first || sent->second != picture->step;
      if (!is_new && !repeats) continue;
      sent->second = picture->step;
      v1::Measurement& measurement = *view.mutable_readings()->mutable_measurements(slot);
      measurement.set_jpeg(jpegOf(picture->image));
      measurement.set_step(picture->step);
      measurement.set_is_new(is_new);
    }
  }
}

}  // namespace robosim
