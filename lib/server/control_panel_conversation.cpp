#include "server/control_panel_conversation.h"

#include <cmath>
#include <optional>
#include <utility>

#include "base/error_list.h"
#include "net/stream_call.h"
#include "net/unary_call.h"
#include "net/wire_error.h"
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
  explicit Call(const char* what_it_asks) : what(what_it_asks) {}
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;
  virtual ~Call() = default;
  virtual std::string who() const = 0;
  virtual void obey(PanelDesk& desk) = 0;
  /// To be called once; nothing happens when it is called again.
  virtual void answer(const wire::RunStatus& reply, const grpc::Status& status) = 0;
  virtual bool isCancelled() const { return false; }

  const char* const what;                   ///< it asks for, for the log; null for what changes nothing
  std::optional<std::uint64_t> until_step;  ///< it is answered after this one
};

/// What a call with one request asks for.
template <typename Request>
struct ControlPanelConversation::Kind {
  const char* what;
  Right right;
  void (ControlPanelConversation::*request)(grpc::ServerContext*, Request*,
                                            grpc::ServerAsyncResponseWriter<wire::RunStatus>*, grpc::CompletionQueue*,
                                            grpc::ServerCompletionQueue*, void*);
  std::function<void(PanelDesk&, const Request&, Call&)> obey;
};

template <typename Request>
class ControlPanelConversation::PlainCall final : public UnaryCall<Request, wire::RunStatus>, public Call {
 public:
  using Unary = UnaryCall<Request, wire::RunStatus>;
  PlainCall(ControlPanelConversation& owner, Kind<Request> kind)
      : Unary(*owner.line_.switchboard), Call(kind.what), owner_(owner), kind_(std::move(kind)) {}

  std::string who() const override { return this->context().peer(); }
  void obey(PanelDesk& desk) override { kind_.obey(desk, this->request(), *this); }
  void answer(const wire::RunStatus& reply, const grpc::Status& status) override { Unary::answer(reply, status); }
  bool isCancelled() const override { return Unary::isCancelled(); }

 private:
  void called() override {
    owner_.awaitCall(kind_);
    grpc::Status status = owner_.lobby_.mayEnter(this->context(), kind_.right);
    try {
      if (status.ok()) checkProtocol(this->request().protocol());
    } catch (const WireError& error) {
      status = {error.code(), error.what()};
    }
    if (status.ok()) {
      owner_.queue(std::static_pointer_cast<PlainCall>(this->shared_from_this()));
    } else {
      answer({}, status);
      owner_.lobby_.logRefusal("control panel " + who() + ": refused: " + status.error_message());
    }
  }

  ControlPanelConversation& owner_;
  const Kind<Request> kind_;
};

/// Gathers the pieces of a world, then waits as the others do.
class ControlPanelConversation::LoadCall final : public StreamCall<wire::WorldPiece, wire::RunStatus>, public Call {
 public:
  explicit LoadCall(ControlPanelConversation& owner)
      : StreamCall(*owner.line_.switchboard), Call("load"), owner_(owner) {}

  std::string who() const override { return peer(); }
  bool isCancelled() const override { return StreamCall::isCancelled(); }
  void obey(PanelDesk& desk) override {
    desk.load(source_);
    desk.run_switch.is_paused = true;
    desk.run_switch.steps_left = 0;
  }
  void answer(const wire::RunStatus& reply, const grpc::Status& status) override {
    if (status.ok()) {
      draft() = reply;
      post();
    }
    end(status);
  }

 private:
  void called() override {
    owner_.awaitLoad();
    if (const auto status = owner_.lobby_.mayEnter(context(), Right::operate); !status.ok()) end(status);
  }
  Turn received(const wire::WorldPiece& piece) override {
    if (bytes_.empty()) checkProtocol(piece.protocol());
    if (bytes_.size() + piece.piece().size() > kMostWorldBytes) {
      throw WireError("a world of more than " + std::to_string(kMostWorldBytes >> 20) + " MiB");
    }
    bytes_ += piece.piece();
    return Turn::theirs;
  }
  void heardAll() override {
    wire::WorldSource message;
    if (bytes_.empty() || !message.ParseFromString(bytes_)) {
      end(badInput("the pieces make no robosim.wire.WorldSource; doc/protocol.md tells what does"));
      return;
    }
    source_ = decode(message);
    owner_.queue(std::static_pointer_cast<LoadCall>(shared_from_this()));
  }
  void refuse(const WireError& error) override { end({error.code(), error.what()}); }
  void ended() override {}

  ControlPanelConversation& owner_;
  std::string bytes_;
  WorldSource source_;
};

/// One panel that watches.
class ControlPanelConversation::Watcher final : public StreamCall<wire::PanelRequest, wire::RunStatus> {
 public:
  explicit Watcher(ControlPanelConversation& owner) : StreamCall(*owner.line_.switchboard), owner_(owner) {}

  bool asks = false;  ///< for a report

 private:
  void called() override {
    owner_.awaitWatcher();
    if (const auto status = owner_.lobby_.mayEnter(context(), Right::look); status.ok()) {
      owner_.watchers_.push_back(std::static_pointer_cast<Watcher>(shared_from_this()));
    } else {
      end(status);
    }
  }
  Turn received(const wire::PanelRequest& message) override {
    checkProtocol(message.protocol());
    asks = true;
    owner_.lobby_.rang = true;
    return Turn::in_measure;
  }
  void refuse(const WireError& error) override { end({error.code(), error.what()}); }
  void ended() override {
    std::erase_if(owner_.watchers_, [&](const auto& watcher) { return watcher.get() == this; });
  }

  ControlPanelConversation& owner_;
};

ControlPanelConversation::ControlPanelConversation(Lobby& lobby) : lobby_(lobby) {}
ControlPanelConversation::~ControlPanelConversation() = default;

void ControlPanelConversation::open(const Switchboard::Line& line) {
  using Self = ControlPanelConversation;
  line_ = line;
  awaitLoad();
  awaitWatcher();
  const auto pause = [](bool is_paused) {
    return [is_paused](PanelDesk& desk, const wire::PanelRequest&, Call&) {
      desk.run_switch.is_paused = is_paused;
      desk.run_switch.steps_left = 0;
    };
  };
  awaitCall<wire::PanelRequest>({"start", Right::operate, &Self::RequestStart, pause(false)});
  awaitCall<wire::PanelRequest>({"pause", Right::operate, &Self::RequestPause, pause(true)});
  awaitCall<wire::PanelRequest>(
      {"stop", Right::operate, &Self::RequestStop,
       [](PanelDesk& desk, const wire::PanelRequest&, Call&) { desk.run_switch.stop = true; }});
  awaitCall<wire::PanelRequest>(
      {nullptr, Right::look, &Self::RequestStatus, [](PanelDesk&, const wire::PanelRequest&, Call&) {}});
  awaitCall<wire::StepRequest>(
      {"step", Right::operate, &Self::RequestStep, [](PanelDesk& desk, const wire::StepRequest& request, Call& call) {
         checkSteps(request.steps());
         desk.run_switch.is_paused = true;
         desk.run_switch.steps_left += request.steps();
         wire::RunStatus status;
         desk.describe(status);
         call.until_step = status.step() + desk.run_switch.steps_left;
       }});
  awaitCall<wire::SpeedRequest>({"speed", Right::operate, &Self::RequestSetSpeed,
                                 [this](PanelDesk& desk, const wire::SpeedRequest& request, Call&) {
                                   checkSpeed(request.speed(), lobby_.pace);
                                   desk.run_switch.speed = request.speed();
                                 }});
}

template <typename Request>
void ControlPanelConversation::awaitCall(const Kind<Request>& kind) {
  std::make_shared<PlainCall<Request>>(*this, kind)->await([&](auto* context, auto* request, auto* wire, void* tag) {
    (this->*kind.request)(context, request, wire, line_.calls, line_.arrivals, tag);
  });
}

void ControlPanelConversation::awaitLoad() {
  std::make_shared<LoadCall>(*this)->await(
      [this](auto* context, auto* wire, void* tag) { RequestLoad(context, wire, line_.calls, line_.arrivals, tag); });
}

void ControlPanelConversation::awaitWatcher() {
  std::make_shared<Watcher>(*this)->await(
      [this](auto* context, auto* wire, void* tag) { RequestWatch(context, wire, line_.calls, line_.arrivals, tag); });
}

void ControlPanelConversation::queue(const std::shared_ptr<Call>& call) {
  if (lobby_.is_over) {
    call->answer({}, Lobby::runIsOver());
    return;
  }
  calls_.push_back(call);
  lobby_.rang = true;
}

void ControlPanelConversation::obey(PanelDesk& desk) {
  for (const auto& call : std::exchange(calls_, {})) {
    obey(desk, *call);
    if (call->until_step) steppers_.push_back(call);
  }
  answerSteppers(desk);
  for (const auto& watcher : watchers_) {
    if (!watcher->asks || !watcher->isIdle()) continue;
    watcher->asks = false;
    desk.describe(watcher->draft());
    watcher->post();
  }
}

void ControlPanelConversation::obey(PanelDesk& desk, Call& call) {
  if (call.isCancelled()) return;
  try {
    call.obey(desk);
    if (call.what) lobby_.log("control panel " + call.who() + ": " + call.what);
    if (call.until_step) return;
    wire::RunStatus reply;
    desk.describe(reply);
    call.answer(reply, grpc::Status::OK);
  } catch (const WireError& error) {
    refuse(call, error.what());
  } catch (const ConfigError& error) {  // of the world
    refuse(call, error.what());
  } catch (const std::exception& error) {  // ours, a disk that is full say
    call.answer({}, {grpc::StatusCode::INTERNAL, "the run ends here: " + std::string(error.what())});
    throw;
  }
}

void ControlPanelConversation::refuse(Call& call, const std::string& why) {
  lobby_.logRefusal("control panel " + call.who() + ": " + (call.what ? call.what : "status") + ": " + why);
  call.answer({}, badInput(why));
}

void ControlPanelConversation::answerSteppers(PanelDesk& desk) {
  if (steppers_.empty()) return;
  wire::RunStatus status;
  desk.describe(status);
  std::erase_if(steppers_, [&](const auto& call) {
    if (call->isCancelled()) return true;
    if (status.step() >= *call->until_step) {
      call->answer(status, grpc::Status::OK);
      return true;
    }
    if (desk.run_switch.mayStep()) return false;
    call->answer({}, {grpc::StatusCode::ABORTED, "another control panel has paused the run at step " +
                                                     std::to_string(status.step()) + ", before step " +
                                                     std::to_string(*call->until_step)});
    return true;
  });
}

void ControlPanelConversation::sayGoodbye(PanelDesk& desk) {
  wire::RunStatus last;
  desk.describe(last);
  for (const auto& call : std::exchange(calls_, {})) call->answer({}, Lobby::runIsOver());
  for (const auto& call : std::exchange(steppers_, {})) {
    call->answer({}, {grpc::StatusCode::ABORTED, "the run has ended before step " + std::to_string(*call->until_step)});
  }
  for (const auto& watcher : watchers_) {
    watcher->draft() = last;
    watcher->post();
    watcher->end(grpc::Status::OK);
  }
}

}  // namespace robosim
