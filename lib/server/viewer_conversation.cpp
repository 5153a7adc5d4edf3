#include "server/viewer_conversation.h"

#include <algorithm>
#include <map>
#include <utility>

#include "net/wire_error.h"
#include "server/sight.h"
#include "server/world_wire.h"

namespace robosim {
namespace {

RobotLook lookOf(const State& state, std::size_t i) {
  return {state.world_from_robot[i], state.laser_pan_rad[i], state.stalled[i] != 0, state.activity[i]};
}

}  // namespace

/// One viewer.
class ViewerConversation::Stream final : public StreamCall<wire::FrameRequest, wire::Frame> {
 public:
  explicit Stream(ViewerConversation& owner) : StreamCall(*owner.line_.switchboard), owner_(owner) {}

  void hangUp(const grpc::Status& status) {
    if (std::exchange(is_gone_, true)) return;
    owner_.lobby_.logRefusal("viewer " + peer() + ": hung up on: " + status.error_message());
    end(status);
  }

  /// Whether it asks for a frame that it has not seen.
  bool isWaitingFor(std::uint64_t step_now) const {
    return asks && isIdle() && (wants_world || step != step_now || shown != wish);
  }

  void answered() {
    asks = false;
    if (has_asked_all_) end(grpc::Status::OK);
  }

  bool asks = false;  ///< for a frame
  ReadingsWish wish;
  bool wants_world = true;                                                   ///< the next frame is a whole one
  std::uint64_t step = 0;                                                    ///< of the last frame sent
  ReadingsWish shown;                                                        ///< whose readings that had
  std::vector<RobotLook> looked;                                             ///< what the viewer knows
  std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> seen_photos;  ///< by robot and sensor: of which step

 private:
  void called() override { owner_.called(*this); }
  Turn received(const wire::FrameRequest& message) override {
    if (!is_known_) checkProtocol(message.protocol());
    is_known_ = true;
    wish = decode(message, owner_.lobby_.exhibit->robot_names.size());
    asks = asks || !message.amends();
    owner_.lobby_.rang = true;
    return Turn::in_measure;
  }
  /// What it has asked for it gets all the same.
  void heardAll() override {
    has_asked_all_ = true;
    if (!asks) end(grpc::Status::OK);
  }
  void refuse(const WireError& error) override { hangUp({error.code(), error.what()}); }
  void ended() override {
    std::erase_if(owner_.streams_, [&](const auto& stream) { return stream.get() == this; });
  }

  ViewerConversation& owner_;
  bool is_gone_ = false;
  bool is_known_ = false;  ///< it has said which protocol it speaks
  bool has_asked_all_ = false;
};

ViewerConversation::ViewerConversation(Lobby& lobby) : lobby_(lobby) {}
ViewerConversation::~ViewerConversation() = default;

void ViewerConversation::open(const Switchboard::Line& line) {
  line_ = line;
  awaitViewer();
}

void ViewerConversation::awaitViewer() {
  std::make_shared<Stream>(*this)->await(
      [this](auto* context, auto* wire, void* tag) { RequestWatch(context, wire, line_.calls, line_.arrivals, tag); });
}

void ViewerConversation::called(Stream& stream) {
  awaitViewer();
  const grpc::Status status = lobby_.mayEnter(stream.context(), Right::look);
  if (status.ok()) {
    streams_.push_back(std::static_pointer_cast<Stream>(stream.shared_from_this()));
  } else {
    stream.hangUp(status);
  }
}

void ViewerConversation::show() {
  album_.clear();
  for (const auto& stream : streams_) stream->wants_world = true;
}

void ViewerConversation::tell() {
  const State& state = lobby_.exhibit->environment.state();
  for (const auto& stream : streams_) {
    for (const auto robot : stream->wish.of) {
      if (robot < state.readings.size()) album_.note(robot, state.readings[robot]);
    }
    if (stream->isWaitingFor(state.time.step)) send(*stream);
  }
}

void ViewerConversation::send(Stream& stream) {
  const Exhibit& exhibit = *lobby_.exhibit;
  const State& state = exhibit.environment.state();
  wire::Frame& frame = stream.draft();
  frame.Clear();
  if (stream.wants_world) {
    encode(exhibit.source, *frame.mutable_world());
    frame.set_world_version(exhibit.world_version);
    frame.set_period_s(state.time.period_s);
    frame.set_may_operate(lobby_.access.check(stream.context(), Right::operate).ok());
  }
  frame.set_step(state.time.step);
  frame.set_time_s(state.time.seconds());
  if (state.winner) frame.set_winner(exhibit.robot_names[*state.winner]);
  stream.looked.resize(exhibit.robot_names.size());
  for (std::size_t i = 0; i < stream.looked.size(); ++i) {
    const RobotLook look = lookOf(state, i);
    if (look == stream.looked[i] && !stream.wants_world) continue;
    stream.looked[i] = look;
    encode(look, i, *frame.add_robots());
  }
  if (stream.wants_world || stream.shown != stream.wish) stream.seen_photos.clear();
  stream.shown = stream.wish;
  encode(state.readings, stream.shown, frame);
  addPhotos(stream, frame);
  stream.wants_world = false;
  stream.step = state.time.step;
  stream.post();
  stream.answered();
}

/// Adds the newest pictures that the viewer has not seen, of those robots that it has named.
void ViewerConversation::addPhotos(Stream& stream, wire::Frame& frame) const {
  for (auto& view : *frame.mutable_readings()) {
    if (!std::binary_search(stream.shown.of.begin(), stream.shown.of.end(), view.robot())) continue;
    for (int slot = 0; slot < view.readings().measurements_size(); ++slot) {
      const auto* photo = album_.find(view.robot(), static_cast<std::size_t>(slot));
      if (!photo) continue;
      const auto [seen, is_first] = stream.seen_photos.try_emplace({view.robot(), slot}, photo->step);
      if (!is_first && seen->second == photo->step) continue;
      seen->second = photo->step;
      view.mutable_readings()->mutable_measurements(slot)->set_jpeg(photo->jpeg);
    }
  }
}

void ViewerConversation::sayGoodbye() {
  for (const auto& stream : streams_) stream->end(grpc::Status::OK);
}

}  // namespace robosim
