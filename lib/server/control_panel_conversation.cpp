#include "server/control_panel_conversation.h"

#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error_list.h"
#include "server/world_wire.h"

namespace robosim {
namespace {

/// More steps than anyone waits for, and more world than anyone has: a typing error, or worse.
constexpr std::uint64_t kMostSteps = 1'000'000'000;
constexpr std::size_t kMostWorldBytes = 256u << 20;

grpc::Status badInput(const std::string& what) { return {grpc::StatusCode::INVALID_ARGUMENT, what}; }

void checkSteps(std::uint64_t steps) {
  if (steps >= 1 && steps <= kMostSteps) return;
  throw WireError(std::to_string(steps) + " steps; must lie in [1, " + std::to_string(kMostSteps) + "]");
}

void checkSpeed(double speed, Pace pace) {
  if (speed == 0 && pace == Pace::realtime) {
    throw WireError("at the pace of real time a run cannot go as fast as it can; give a speed, 1 being real time");
  }
  if (speed == 0 || (speed >= 0.001 && speed <= 1e6)) return;
  throw WireError("a speed of " + std::to_string(speed) +
                  "; must lie in [0.001, 1000000], or be 0 for as fast as it can");
}

}  // namespace

/// A call that waits for its answer.
class ControlPanelConversation::Call {
 public:
  Call(std::string panel, const char* what_it_asks, wire::RunStatus* reply_to_fill, Wish its_wish)
      : who(std::move(panel)), what(what_it_asks), reply(reply_to_fill), wish(std::move(its_wish)) {}
  virtual ~Call() = default;
  /// To be called once; nothing happens when it is called again.
  virtual void answer(const grpc::Status&) = 0;

  std::string who;
  const char* what;  ///< it asks for, for the log; null for what changes nothing
  wire::RunStatus* reply;
  Wish wish;
  std::optional<std::uint64_t> until_step;  ///< it is answered after this one
  std::atomic<bool> is_cancelled = false;
};

/// The same as gRPC has it: lives until gRPC has done with it.
template <typename Reactor>
class ControlPanelConversation::ReactingCall : public Reactor, public Call {
 public:
  using Call::Call;
  void begin(const std::shared_ptr<Call>& self) { self_ = self; }
  const std::shared_ptr<Call>& self() const { return self_; }  ///< until it is answered
  void answer(const grpc::Status& status) override {
    if (is_answered_.exchange(true)) return;
    this->Finish({status.error_code(), fitForStatus(status.error_message())});
  }

 private:
  void OnCancel() override { is_cancelled = true; }
  void OnDone() override { const auto last = std::move(self_); }

  std::shared_ptr<Call> self_;
  std::atomic<bool> is_answered_ = false;
};

/// Gathers the pieces of a world, then waits as the others do.
class ControlPanelConversation::LoadCall final : public ReactingCall<grpc::ServerReadReactor<wire::WorldPiece>> {
 public:
  LoadCall(ControlPanelConversation& owner, const std::string& panel, wire::RunStatus* reply_to_fill)
      : ReactingCall(panel, "load", reply_to_fill,
                     [this](PanelDesk& desk, Call&) {
                       desk.load(source_);
                       desk.run_switch.is_paused = true;
                       desk.run_switch.steps_left = 0;
                     }),
        owner_(owner) {}

  void read() { StartRead(&piece_); }

 private:
  void OnReadDone(bool ok) override {
    try {
      if (!ok) {
        take();
        return;
      }
      if (bytes_.empty()) checkProtocol(piece_.protocol());
      if (bytes_.size() + piece_.piece().size() > kMostWorldBytes) {
        throw WireError("a world of more than " + std::to_string(kMostWorldBytes >> 20) + " MiB");
      }
      bytes_ += piece_.piece();
      StartRead(&piece_);
    } catch (const WireError& error) {
      answer({error.code(), error.what()});
    }
  }

  void take() {
    wire::WorldSource message;
    if (bytes_.empty() || !message.ParseFromString(bytes_)) {
      throw WireError("the pieces make no robosim.wire.WorldSource; doc/protocol.md tells what does");
    }
    source_ = decode(message);
    owner_.queue(self());
  }

  ControlPanelConversation& owner_;
  wire::WorldPiece piece_;
  std::string bytes_;
  WorldSource source_;
};

/// One panel that watches. What is below is touched with the lobby's mutex held.
class ControlPanelConversation::Watcher final : public ServerStream<wire::PanelRequest, wire::RunStatus> {
 public:
  Watcher(ControlPanelConversation& owner, grpc::CallbackServerContext* context)
      : ServerStream(context), owner_(owner) {}

  void received(const wire::PanelRequest& message) override {
    checkProtocol(message.protocol());
    const std::lock_guard lock(owner_.lobby_.mutex);
    asks = true;
    owner_.lobby_.bell.notify_all();
  }
  void refuse(const WireError& error) override { end({error.code(), error.what()}); }
  void ended() override {
    const std::lock_guard lock(owner_.lobby_.mutex);
    std::erase_if(owner_.watchers_, [&](const auto& watcher) { return watcher.get() == this; });
  }

 private:
  ControlPanelConversation& owner_;

 public:
  bool asks = false;  ///< for a report
};

ControlPanelConversation::ControlPanelConversation(Lobby& lobby) : lobby_(lobby) {}
ControlPanelConversation::~ControlPanelConversation() = default;

grpc::Status ControlPanelConversation::mayEnter(grpc::CallbackServerContext* context, Right right) const {
  const std::lock_guard lock(lobby_.mutex);
  return lobby_.mayEnter(*context, right);
}

grpc::ServerUnaryReactor* ControlPanelConversation::take(grpc::CallbackServerContext* context, Right right,
                                                         std::uint32_t protocol, wire::RunStatus* reply,
                                                         const char* what, Wish wish) {
  auto call = std::make_shared<ReactingCall<grpc::ServerUnaryReactor>>(context->peer(), what, reply, std::move(wish));
  call->begin(call);
  grpc::Status status = mayEnter(context, right);
  try {
    if (status.ok()) checkProtocol(protocol);
  } catch (const WireError& error) {
    status = {error.code(), error.what()};
  }
  if (status.ok()) {
    queue(call);
  } else {
    call->answer(status);
    const std::lock_guard lock(lobby_.mutex);
    lobby_.log("control panel " + call->who + ": refused: " + status.error_message());
  }
  return call.get();
}

void ControlPanelConversation::queue(const std::shared_ptr<Call>& call) {
  const std::lock_guard lock(lobby_.mutex);
  if (lobby_.is_over) {
    call->answer(Lobby::runIsOver());
    return;
  }
  calls_.push_back(call);
  lobby_.bell.notify_all();
}

grpc::ServerReadReactor<wire::WorldPiece>* ControlPanelConversation::Load(grpc::CallbackServerContext* context,
                                                                          wire::RunStatus* reply) {
  auto call = std::make_shared<LoadCall>(*this, context->peer(), reply);
  call->begin(call);
  const grpc::Status status = mayEnter(context, Right::operate);
  if (status.ok()) {
    call->read();
  } else {
    call->answer(status);
  }
  return call.get();
}

grpc::ServerUnaryReactor* ControlPanelConversation::Start(grpc::CallbackServerContext* context,
                                                          const wire::PanelRequest* request, wire::RunStatus* reply) {
  return take(context, Right::operate, request->protocol(), reply, "start", [](PanelDesk& desk, Call&) {
    desk.run_switch.is_paused = false;
    desk.run_switch.steps_left = 0;
  });
}

grpc::ServerUnaryReactor* ControlPanelConversation::Pause(grpc::CallbackServerContext* context,
                                                          const wire::PanelRequest* request, wire::RunStatus* reply) {
  return take(context, Right::operate, request->protocol(), reply, "pause", [](PanelDesk& desk, Call&) {
    desk.run_switch.is_paused = true;
    desk.run_switch.steps_left = 0;
  });
}

grpc::ServerUnaryReactor* ControlPanelConversation::Step(grpc::CallbackServerContext* context,
                                                         const wire::StepRequest* request, wire::RunStatus* reply) {
  return take(context, Right::operate, request->protocol(), reply, "step",
              [steps = request->steps()](PanelDesk& desk, Call& call) {
                checkSteps(steps);
                desk.run_switch.is_paused = true;
                desk.run_switch.steps_left += steps;
                desk.describe(*call.reply);
                call.until_step = call.reply->step() + desk.run_switch.steps_left;
              });
}

grpc::ServerUnaryReactor* ControlPanelConversation::SetSpeed(grpc::CallbackServerContext* context,
                                                             const wire::SpeedRequest* request,
                                                             wire::RunStatus* reply) {
  return take(context, Right::operate, request->protocol(), reply, "speed",
              [this, speed = request->speed()](PanelDesk& desk, Call&) {
                checkSpeed(speed, lobby_.pace);
                desk.run_switch.speed = speed;
              });
}

grpc::ServerUnaryReactor* ControlPanelConversation::Stop(grpc::CallbackServerContext* context,
                                                         const wire::PanelRequest* request, wire::RunStatus* reply) {
  return take(context, Right::operate, request->protocol(), reply, "stop",
              [](PanelDesk& desk, Call&) { desk.run_switch.stop = true; });
}

grpc::ServerUnaryReactor* ControlPanelConversation::Status(grpc::CallbackServerContext* context,
                                                           const wire::PanelRequest* request, wire::RunStatus* reply) {
  return take(context, Right::look, request->protocol(), reply, nullptr, [](PanelDesk&, Call&) {});
}

RawStream* ControlPanelConversation::Watch(grpc::CallbackServerContext* context) {
  auto watcher = std::make_shared<Watcher>(*this, context);
  watcher->begin();
  const std::lock_guard lock(lobby_.mutex);
  if (const auto status = lobby_.mayEnter(*context, Right::look); status.ok()) {
    watchers_.push_back(watcher);
  } else {
    watcher->end(status);
  }
  return watcher.get();
}

bool ControlPanelConversation::isAsked() const { return !calls_.empty(); }

void ControlPanelConversation::obey(PanelDesk& desk) {
  std::vector<std::shared_ptr<Call>> calls;
  {
    const std::lock_guard lock(lobby_.mutex);
    calls.swap(calls_);
  }
  for (const auto& call : calls) {
    obey(desk, *call);
    if (call->until_step) steppers_.push_back(call);
  }
  answerSteppers(desk);

  std::vector<std::shared_ptr<Watcher>> asking;
  {
    const std::lock_guard lock(lobby_.mutex);
    for (const auto& watcher : watchers_) {
      if (!watcher->asks || !watcher->isIdle()) continue;
      watcher->asks = false;
      asking.push_back(watcher);
    }
  }
  for (const auto& watcher : asking) {
    desk.describe(watcher->draft());
    watcher->post();
  }
}

void ControlPanelConversation::obey(PanelDesk& desk, Call& call) {
  if (call.is_cancelled) {
    call.answer(grpc::Status::CANCELLED);
    return;
  }
  try {
    call.wish(desk, call);
    if (call.what) {
      const std::lock_guard lock(lobby_.mutex);
      lobby_.log("control panel " + call.who + ": " + call.what);
    }
    if (call.until_step) return;
    desk.describe(*call.reply);
    call.answer(grpc::Status::OK);
  } catch (const std::runtime_error& error) {  // WireError, or a ConfigError of the world
    call.answer(badInput(error.what()));
  }
}

void ControlPanelConversation::answerSteppers(PanelDesk& desk) {
  std::erase_if(steppers_, [&](const auto& call) {
    if (call->is_cancelled) {
      call->answer(grpc::Status::CANCELLED);
      return true;
    }
    desk.describe(*call->reply);
    if (call->reply->step() >= *call->until_step) {
      call->answer(grpc::Status::OK);
      return true;
    }
    if (desk.run_switch.mayStep()) return false;
    call->answer({grpc::StatusCode::ABORTED, "another control panel has paused the run at step " +
                                                 std::to_string(call->reply->step()) + ", before step " +
                                                 std::to_string(*call->until_step)});
    return true;
  });
}

void ControlPanelConversation::sayGoodbye(PanelDesk& desk) {
  wire::RunStatus last;
  desk.describe(last);
  const std::lock_guard lock(lobby_.mutex);
  for (const auto& call : std::exchange(calls_, {})) call->answer(Lobby::runIsOver());
  for (const auto& call : std::exchange(steppers_, {})) {
    call->answer({grpc::StatusCode::ABORTED, "the run has ended before step " + std::to_string(*call->until_step)});
  }
  for (const auto& watcher : std::exchange(watchers_, {})) {
    watcher->draft() = last;
    watcher->post();
    watcher->end(grpc::Status::OK);
  }
}

}  // namespace robosim
