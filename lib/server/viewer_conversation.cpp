#include "server/viewer_conversation.h"

#include <algorithm>
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
class ViewerConversation::Stream final : public ServerStream<wire::FrameRequest, wire::Frame> {
 public:
  Stream(ViewerConversation& owner, grpc::CallbackServerContext* context, bool has_operators_token)
      : ServerStream(context), owner_(owner), may_operate(has_operators_token) {}

  Turn received(const wire::FrameRequest& message) override {
    ReadingsWish wished = decode(message);
    const std::lock_guard lock(owner_.lobby_.mutex);
    if (!is_known) checkProtocol(message.protocol());
    is_known = true;
    const auto& world = owner_.lobby_.exhibit->robot_names;
    wished.of.erase(std::lower_bound(wished.of.begin(), wished.of.end(), world.size()), wished.of.end());
    wish = std::move(wished);
    asks = asks || !message.amends();
    owner_.lobby_.bell.notify_all();
    return Turn::theirs;  // it may amend what it asks
  }

  /// What it has asked for it gets all the same.
  void heardAll() override {
    const std::lock_guard lock(owner_.lobby_.mutex);
    has_asked_all = true;
    if (!asks && !is_being_told) end(grpc::Status::OK);
  }

  void refuse(const WireError& error) override {
    const std::lock_guard lock(owner_.lobby_.mutex);
    hangUp({error.code(), error.what()});
  }

  void hangUp(const grpc::Status& status) {
    if (std::exchange(is_gone, true)) return;
    owner_.lobby_.log("viewer " + context()->peer() + ": hung up on: " + status.error_message());
    end(status);
  }

  void ended() override {
    const std::lock_guard lock(owner_.lobby_.mutex);
    std::erase_if(owner_.streams_, [&](const auto& stream) { return stream.get() == this; });
  }

 private:
  ViewerConversation& owner_;

 public:
  const bool may_operate;  ///< whether its token is a control panel's too
  /// @name Touched with the lobby's mutex held
  ///@{
  bool is_gone = false;
  bool is_known = false;  ///< it has said which protocol it speaks
  bool asks = false;      ///< for a frame
  bool has_asked_all = false;
  bool is_being_told = false;
  ReadingsWish wish;
  ///@}
  /// @name Touched by the thread that steps only
  ///@{
  bool wants_world = true;        ///< the next frame is a whole one
  std::uint64_t step = 0;         ///< of the last frame sent
  ReadingsWish shown;             ///< whose readings that had
  std::vector<RobotLook> looked;  ///< what the viewer knows
  ///@}
};

ViewerConversation::ViewerConversation(Lobby& lobby) : lobby_(lobby) {}
ViewerConversation::~ViewerConversation() = default;

RawStream* ViewerConversation::Watch(grpc::CallbackServerContext* context) {
  const bool may_operate = lobby_.access.check(*context, Right::operate).ok();
  auto stream = std::make_shared<Stream>(*this, context, may_operate);
  stream->begin();
  const std::lock_guard lock(lobby_.mutex);
  const grpc::Status status = lobby_.mayEnter(*context, Right::look);
  if (status.ok()) {
    streams_.push_back(stream);
  } else {
    stream->hangUp(status);
  }
  return stream.get();
}

void ViewerConversation::show() {
  for (const auto& stream : streams_) stream->wants_world = true;
}

void ViewerConversation::tell() {
  const std::uint64_t step = lobby_.exhibit->environment.time().step;
  asking_.clear();
  {
    const std::lock_guard lock(lobby_.mutex);
    for (const auto& stream : streams_) {
      if (!stream->asks || !stream->isIdle()) continue;
      if (!stream->wants_world && stream->step == step && stream->shown == stream->wish) continue;
      stream->asks = false;
      stream->is_being_told = true;
      stream->shown = stream->wish;
      asking_.push_back(stream);
    }
  }
  // A frame may be large, and robots' answers must not wait for the mutex meanwhile.
  for (const auto& stream : asking_) send(*stream);
  const std::lock_guard lock(lobby_.mutex);
  for (const auto& stream : asking_) {
    stream->is_being_told = false;
    if (stream->has_asked_all && !stream->asks) stream->end(grpc::Status::OK);
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
    frame.set_may_operate(stream.may_operate);
  }
  frame.set_step(state.time.step);
  frame.set_time_s(state.time.seconds());
  stream.looked.resize(exhibit.robot_names.size());
  for (std::size_t i = 0; i < stream.looked.size(); ++i) {
    const RobotLook look = lookOf(state, i);
    if (look == stream.looked[i] && !stream.wants_world) continue;
    stream.looked[i] = look;
    encode(look, i, *frame.add_robots());
  }
  encode(state.readings, stream.shown, frame);
  stream.wants_world = false;
  stream.step = state.time.step;
  stream.post();
}

void ViewerConversation::sayGoodbye() {
  const std::lock_guard lock(lobby_.mutex);
  for (const auto& stream : streams_) stream->end(grpc::Status::OK);
}

std::size_t ViewerConversation::count() const {
  const std::lock_guard lock(lobby_.mutex);
  return streams_.size();
}

}  // namespace robosim
