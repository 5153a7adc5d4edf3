#include "server/control_panel_session.h"

#include <cmath>
#include <optional>
#include <utility>

#include "base/error_list.h"
#include "net/flood_guard.h"
#include "net/stream_call.h"
#include "net/unary_call.h"
#include "net/wire_error.h"
#include "server/world_pieces.h"

namespace robosim {
namespace {

/// Upper limit of a step request; rejects typing errors.
constexpr std::uint64_t kStepsMax = 1'000'000'000;

grpc::Status badInput(const std::string& what) { return {grpc::StatusCode::INVALID_ARGUMENT, what}; }

void checkSteps(std::uint64_t steps) {
  if (steps >= 1 && steps <= kStepsMax) return;
  throw WireError(std::to_string(steps) + " steps; must lie in [1, " + std::to_string(kStepsMax) + "]");
}

void checkSpeed(double speed, Pace pace) {
  if (speed == 0 && pace == Pace::realtime) {
    throw WireError("at the pace of real time a run cannot go as fast as it can; give a speed, 1 being real time");
  }
  if (speed == 0 || (speed >= 0.001 && speed <= 1e6)) return;
  throw WireError("a speed of " + std::to_string(speed) +
                  "; must lie in [0.001, 1000000], or be 0 for as fast as it can");
}

/// Parameters of a request for the audit log.
std::string detailsOf(const wire::PanelRequest&) { return ""; }
std::string detailsOf(const wire::StepRequest& request) { return " " + std::to_string(request.steps()); }
std::string detailsOf(const wire::SpeedRequest& request) {
  return request.speed() == 0 ? " max" : " " + std::to_string(request.speed());
}

}  // namespace

/// A call that has not been answered yet.
class ControlPanelSession::Call {
 public:
  Call(const char* what_it_asks, Right required) : what(what_it_asks), right(required) {}
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;
  virtual ~Call() = default;
  virtual std::string who() const = 0;
  virtual std::string details() const = 0;  ///< for the audit log
  virtual void execute(RunOperations& operations) = 0;
  /// Answers the call; later calls have no effect.
  virtual void answer(const wire::RunStatus& reply, const grpc::Status& status) = 0;
  virtual bool isCancelled() const { return false; }

  const char* const what;  ///< requested operation for the log; null for read-only calls
  const Right right;       ///< required
  Identity client;
  std::optional<std::uint64_t> until_step;  ///< the call is answered after this step
};

/// Method of the service with one request: its name, the right it requires, and its implementation.
template <typename Request>
struct ControlPanelSession::Kind {
  const char* what;
  Right right;
  void (ControlPanelSession::*request)(grpc::ServerContext*, Request*,
                                       grpc::ServerAsyncResponseWriter<wire::RunStatus>*, grpc::CompletionQueue*,
                                       grpc::ServerCompletionQueue*, void*);
  std::function<void(RunOperations&, const Request&, Call&)> execute;
};

template <typename Request>
class ControlPanelSession::PlainCall final : public UnaryCall<Request, wire::RunStatus>, public Call {
 public:
  using Unary = UnaryCall<Request, wire::RunStatus>;
  PlainCall(ControlPanelSession& owner, Kind<Request> kind)
      : Unary(*owner.queues_.queue_server), Call(kind.what, kind.right), owner_(owner), kind_(std::move(kind)) {}

  std::string who() const override { return this->context().peer(); }
  std::string details() const override { return detailsOf(this->request()); }
  void execute(RunOperations& operations) override { kind_.execute(operations, this->request(), *this); }
  void answer(const wire::RunStatus& reply, const grpc::Status& status) override { Unary::answer(reply, status); }
  bool isCancelled() const override { return Unary::isCancelled(); }

 private:
  void called() override {
    owner_.awaitCall(kind_);
    grpc::Status status = owner_.serving_.authorizeCall(this->context(), kind_.right, this->client);
    try {
      if (status.ok()) checkProtocol(this->request().protocol());
    } catch (const WireError& error) {
      status = {error.code(), error.what()};
    }
    if (status.ok()) {
      owner_.queue(std::static_pointer_cast<PlainCall>(this->shared_from_this()));
    } else {
      answer({}, status);
      owner_.serving_.logRefusal("control panel " + who() + ": refused: " + status.error_message(),
                                 "refused control panels");
    }
  }

  ControlPanelSession& owner_;
  const Kind<Request> kind_;
};

/// Receives the pieces of a world. One load at a time is accepted, which bounds the memory used to one world.
class ControlPanelSession::LoadCall final : public StreamCall<wire::WorldPiece, wire::RunStatus>, public Call {
 public:
  explicit LoadCall(ControlPanelSession& owner)
      : StreamCall(*owner.queues_.queue_server), Call("load", Right::operate), owner_(owner) {}

  enum class State { receiving, complete, over };
  State state = State::receiving;
  ServingState::Clock::time_point since;
  WorldPieces pieces;

  std::string who() const override { return peer(); }
  std::string details() const override { return " " + world_; }
  bool isCancelled() const override { return StreamCall::isCancelled(); }
  void execute(RunOperations& operations) override {
    operations.replace(owner_.prepared_.get());
    wire::RunStatus status;
    operations.describe(status);
    world_ = status.world();
    operations.run_control.is_paused = true;
    operations.run_control.steps_left = 0;
  }
  void answer(const wire::RunStatus& reply, const grpc::Status& status) override {
    state = State::over;
    if (status.ok()) {
      draft() = reply;
      post();
    }
    end(status);
  }
  void disconnect(const grpc::Status& status) {
    owner_.pending_loads_.remove(*this);
    owner_.serving_.logRefusal("control panel " + peer() + ": load: refused: " + status.error_message(),
                               "refused control panels");
    answer({}, status);
  }

 private:
  void called() override {
    owner_.awaitLoad();
    grpc::Status status = owner_.serving_.authorizeCall(context(), Right::operate, client);
    if (status.ok()) exemption_ = flood_guard::Exemption(peer());
    if (status.ok() && owner_.isLoading()) status = busy();
    if (status.ok()) {
      owner_.pending_loads_.add(std::static_pointer_cast<LoadCall>(shared_from_this()));
    } else {
      disconnect(status);
    }
  }
  ReadPolicy received(const wire::WorldPiece& piece) override {
    if (state != State::receiving) return ReadPolicy::immediate;
    if (owner_.load_.get() != this) begin(piece);
    pieces.add(piece.piece());
    return ReadPolicy::immediate;
  }
  /// Makes this call the active load, on its first piece.
  void begin(const wire::WorldPiece& piece) {
    owner_.pending_loads_.remove(*this);
    checkProtocol(piece.protocol());
    if (owner_.isLoading()) throw WireError(busy().error_message(), busy().error_code());
    since = owner_.serving_.now();
    owner_.load_ = std::static_pointer_cast<LoadCall>(shared_from_this());
  }
  static grpc::Status busy() {
    return {grpc::StatusCode::RESOURCE_EXHAUSTED,
            "the environment is loading a world for another call; load again when that is done"};
  }
  void readsDone() override {
    if (state != State::receiving) return;
    if (pieces.empty()) {
      disconnect(badInput("no piece of a robosim.wire.WorldSource came; see doc/protocol.md"));
      return;
    }
    state = State::complete;
    owner_.serving_.wake_requested = true;
  }
  void refuse(const WireError& error) override { disconnect({error.code(), error.what()}); }
  void ended() override {
    owner_.pending_loads_.remove(*this);
    state = State::over;
  }

  ControlPanelSession& owner_;
  flood_guard::Exemption exemption_;  ///< a world is large
  std::string world_;                 ///< name of the loaded world
};

/// Stream of statuses to one control panel.
class ControlPanelSession::Watcher final : public StreamCall<wire::PanelRequest, wire::RunStatus> {
 public:
  explicit Watcher(ControlPanelSession& owner) : StreamCall(*owner.queues_.queue_server), owner_(owner) {}

  void disconnect(const grpc::Status& status) {
    owner_.pending_watchers_.remove(*this);
    owner_.serving_.logRefusal("control panel " + peer() + ": watch: refused: " + status.error_message(),
                               "refused control panels");
    end(status);
  }

  bool has_request = false;  ///< for a status
  Identity client;

 private:
  void called() override {
    owner_.awaitWatcher();
    if (const auto status = owner_.serving_.authorizeCall(context(), Right::look, client); status.ok()) {
      owner_.watchers_.push_back(std::static_pointer_cast<Watcher>(shared_from_this()));
      owner_.pending_watchers_.add(owner_.watchers_.back());
    } else {
      disconnect(status);
    }
  }
  ReadPolicy received(const wire::PanelRequest& message) override {
    owner_.pending_watchers_.remove(*this);
    checkProtocol(message.protocol());
    has_request = true;
    owner_.serving_.wake_requested = true;
    return ReadPolicy::rate_limited;
  }
  void refuse(const WireError& error) override { disconnect({error.code(), error.what()}); }
  void ended() override {
    owner_.pending_watchers_.remove(*this);
    std::erase_if(owner_.watchers_, [&](const auto& watcher) { return watcher.get() == this; });
  }

  ControlPanelSession& owner_;
};

ControlPanelSession::ControlPanelSession(ServingState& serving)
    : serving_(serving), pending_watchers_(serving), pending_loads_(serving) {}
ControlPanelSession::~ControlPanelSession() = default;

void ControlPanelSession::open(const CompletionQueueServer::ServiceQueues& queues) {
  using Self = ControlPanelSession;
  queues_ = queues;
  awaitLoad();
  awaitWatcher();
  const auto pause = [](bool is_paused) {
    return [is_paused](RunOperations& operations, const wire::PanelRequest&, Call&) {
      operations.run_control.is_paused = is_paused;
      operations.run_control.steps_left = 0;
    };
  };
  awaitCall<wire::PanelRequest>({"start", Right::operate, &Self::RequestStart, pause(false)});
  awaitCall<wire::PanelRequest>({"pause", Right::operate, &Self::RequestPause, pause(true)});
  awaitCall<wire::PanelRequest>(
      {"stop", Right::operate, &Self::RequestStop,
       [](RunOperations& operations, const wire::PanelRequest&, Call&) { operations.run_control.stop = true; }});
  awaitCall<wire::PanelRequest>(
      {nullptr, Right::look, &Self::RequestStatus, [](RunOperations&, const wire::PanelRequest&, Call&) {}});
  awaitCall<wire::StepRequest>({"step", Right::operate, &Self::RequestStep,
                                [](RunOperations& operations, const wire::StepRequest& request, Call& call) {
                                  checkSteps(request.steps());
                                  operations.run_control.is_paused = true;
                                  operations.run_control.steps_left += request.steps();
                                  wire::RunStatus status;
                                  operations.describe(status);
                                  call.until_step = status.step() + operations.run_control.steps_left;
                                }});
  awaitCall<wire::SpeedRequest>({"speed", Right::operate, &Self::RequestSetSpeed,
                                 [this](RunOperations& operations, const wire::SpeedRequest& request, Call&) {
                                   checkSpeed(request.speed(), serving_.pace);
                                   operations.run_control.speed = request.speed();
                                 }});
}

template <typename Request>
void ControlPanelSession::awaitCall(const Kind<Request>& kind) {
  std::make_shared<PlainCall<Request>>(*this, kind)->await([&](auto* context, auto* request, auto* wire, void* tag) {
    (this->*kind.request)(context, request, wire, queues_.call_queue, queues_.notification_queue, tag);
  });
}

void ControlPanelSession::awaitLoad() {
  std::make_shared<LoadCall>(*this)->await([this](auto* context, auto* wire, void* tag) {
    RequestLoad(context, wire, queues_.call_queue, queues_.notification_queue, tag);
  });
}

void ControlPanelSession::awaitWatcher() {
  std::make_shared<Watcher>(*this)->await([this](auto* context, auto* wire, void* tag) {
    RequestWatch(context, wire, queues_.call_queue, queues_.notification_queue, tag);
  });
}

void ControlPanelSession::queue(const std::shared_ptr<Call>& call) {
  if (serving_.is_over) {
    call->answer({}, ServingState::runIsOver());
    return;
  }
  calls_.push_back(call);
  serving_.wake_requested = true;
}

bool ControlPanelSession::isLoading() const {
  return prepared_.valid() || (load_ && load_->state != LoadCall::State::over);
}

void ControlPanelSession::advanceLoad(RunOperations& operations) {
  if (!load_) return;
  if (!prepared_.valid()) {
    if (load_->state == LoadCall::State::complete) {
      beginPreparing(operations);
    } else if (load_->state == LoadCall::State::over) {
      load_.reset();
    } else if (serving_.now() - load_->since >= serving_.load_deadline) {
      const auto s = std::chrono::duration_cast<std::chrono::seconds>(serving_.load_deadline).count();
      load_->answer({}, {grpc::StatusCode::DEADLINE_EXCEEDED,
                         "the world has not come within " + std::to_string(s) + " s; load it again over a faster way"});
    }
    return;
  }
  if (prepared_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const std::shared_ptr<LoadCall> call = std::exchange(load_, nullptr);
  if (call->state == LoadCall::State::complete) execute(operations, *call);
  prepared_ = {};
}

void ControlPanelSession::beginPreparing(RunOperations& operations) {
  serving_.log("control panel " + load_->who() + ": loads a world of " + std::to_string(load_->pieces.bytes()) +
               " bytes; the run goes on until that is built");
  const auto pieces = std::make_shared<WorldPieces>(std::move(load_->pieces));
  prepared_ = std::async(std::launch::async, [pieces, prepare = operations.prepare] {
    const WorldSource source = pieces->takeSource();
    return prepare(source);
  });
}

void ControlPanelSession::checkAccess() {
  for (const auto& watcher : watchers_) {
    if (const auto status = serving_.access.check(watcher->client, Right::look); !status.ok())
      watcher->disconnect(status);
  }
  std::erase_if(steppers_, [&](const auto& call) {
    const auto status = serving_.access.check(call->client, call->right);
    if (!status.ok()) call->answer({}, status);
    return !status.ok();
  });
}

void ControlPanelSession::execute(RunOperations& operations) {
  while (const auto late_call = pending_watchers_.overdue()) late_call->disconnect(pending_watchers_.timeoutStatus());
  while (const auto late_call = pending_loads_.overdue()) late_call->disconnect(pending_loads_.timeoutStatus());
  advanceLoad(operations);
  for (const auto& call : std::exchange(calls_, {})) {
    execute(operations, *call);
    if (call->until_step) steppers_.push_back(call);
  }
  answerSteppers(operations);
  for (const auto& watcher : watchers_) {
    if (!watcher->has_request || !watcher->isIdle()) continue;
    watcher->has_request = false;
    operations.describe(watcher->draft());
    watcher->post();
  }
}

void ControlPanelSession::execute(RunOperations& operations, Call& call) {
  if (call.isCancelled()) return;
  // A load may have taken so long that its token is no longer valid.
  if (const auto status = serving_.access.check(call.client, call.right); !status.ok()) {
    call.answer({}, status);
    return;
  }
  try {
    call.execute(operations);
    if (call.what) serving_.audit.write(call.client, call.who(), call.what + call.details());
    if (call.until_step) return;
    wire::RunStatus reply;
    operations.describe(reply);
    call.answer(reply, grpc::Status::OK);
  } catch (const WireError& error) {
    refuse(call, error.what());
  } catch (const ConfigError& error) {  // in the world
    refuse(call, error.what());
  } catch (const std::exception& error) {  // an error of the server itself, for example a full disk
    call.answer({}, {grpc::StatusCode::INTERNAL, "the run ends here: " + std::string(error.what())});
    throw;
  }
}

void ControlPanelSession::refuse(Call& call, const std::string& why) {
  serving_.logRefusal("control panel " + call.who() + ": " + (call.what ? call.what : "status") + ": " + why +
                          serving_.tokenSuffix(call.client),
                      "refused control panels");
  call.answer({}, badInput(why));
}

void ControlPanelSession::answerSteppers(RunOperations& operations) {
  if (steppers_.empty()) return;
  wire::RunStatus status;
  operations.describe(status);
  std::erase_if(steppers_, [&](const auto& call) {
    if (call->isCancelled()) return true;
    if (status.step() >= *call->until_step) {
      call->answer(status, grpc::Status::OK);
      return true;
    }
    if (operations.run_control.mayStep()) return false;
    call->answer({}, {grpc::StatusCode::ABORTED, "another control panel has paused the run at step " +
                                                     std::to_string(status.step()) + ", before step " +
                                                     std::to_string(*call->until_step)});
    return true;
  });
}

void ControlPanelSession::endAll(RunOperations& operations) {
  wire::RunStatus last;
  operations.describe(last);
  for (const auto& call : std::exchange(calls_, {})) call->answer({}, ServingState::runIsOver());
  if (const auto load = std::exchange(load_, nullptr)) load->answer({}, ServingState::runIsOver());
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
