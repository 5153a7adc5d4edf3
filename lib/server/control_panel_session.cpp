#include "server/control_panel_session.h"

#include <algorithm>
#include <exception>
#include <future>
#include <optional>
#include <utility>

#include "base/error_list.h"
#include "net/stream_session.h"
#include "net/unary_session.h"
#include "net/wire_error.h"
#include "server/world_pieces.h"

namespace robosim {
namespace {

/// Upper limit of a step request; rejects typing errors.
constexpr std::uint64_t kStepsMax = 1'000'000'000;

/// Index of a method in the service.
int indexOf(const char* method) {
  return v1::RunStatus::descriptor()->file()->FindServiceByName("ControlPanel")->FindMethodByName(method)->index();
}

SessionRules rulesFor(Right right) {
  return {.right = right, .log_kind = "refused control panels", .refused_word = "refused"};
}

void checkSteps(std::uint64_t steps) {
  if (steps >= 1 && steps <= kStepsMax) return;
  throw WireError(std::to_string(steps) + " steps; must lie in [1, " + std::to_string(kStepsMax) + "]");
}

void checkSpeed(double speed, Pace pace) {
  if (speed == 0 && pace == Pace::realtime) {
    throw WireError("with the pace realtime the speed cannot be unlimited; specify a speed, 1 for real time");
  }
  if (speed == 0 || (speed >= 0.001 && speed <= 1e6)) return;
  throw WireError("a speed of " + std::to_string(speed) +
                  "; must lie in [0.001, 1000000], or be 0 for unlimited speed");
}

/// Shortest time between two statuses of a watcher: a status takes time proportional to the number of robots, on the
/// thread that steps the run.
constexpr std::chrono::milliseconds kIntervalMin(50);

/// Minimum time between two statuses of a watcher.
ServingState::Clock::duration intervalOf(const v1::WatchRequest& request) {
  const double s = request.min_interval_s();
  if (!(s >= 0 && s <= 3600)) {
    throw WireError("a minimum interval of " + std::to_string(s) + " s; must lie in [0, 3600]");
  }
  return std::max<ServingState::Clock::duration>(
      kIntervalMin, std::chrono::duration_cast<ServingState::Clock::duration>(std::chrono::duration<double>(s)));
}

/// Parameters of a request for the audit log.
std::string detailsOf(const google::protobuf::Message&) { return ""; }
std::string detailsOf(const v1::StepRequest& request) { return " " + std::to_string(request.steps()); }
std::string detailsOf(const v1::SetSpeedRequest& request) {
  return request.speed() == 0 ? " max" : " " + std::to_string(request.speed());
}
std::string detailsOf(const v1::SetRecordingRequest& request) { return request.on() ? " on" : " off"; }

void setRecording(RunOperations& operations, bool on) {
  try {
    operations.set_recording(on);
  } catch (const ConfigError& error) {  // not of the world
    throw WireError(errorStatus(v1::ERROR_REASON_RECORDING_UNAVAILABLE, error.what()));
  }
}

}  // namespace

WatchAsStream::WatchAsStream() {
  const int watch = indexOf("Watch");
  MarkMethodStreamed(watch, nullptr);
  MarkMethodRaw(watch);
}

/// A call that changes the run or reports its status, between steps.
class ControlPanelSession::Call {
 public:
  explicit Call(const char* operation) : what(operation) {}
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;
  virtual ~Call() = default;
  virtual ServerSession& session() = 0;
  virtual std::string details() const = 0;  ///< for the audit log
  virtual void execute(RunOperations& operations) = 0;
  /// Answers the call; later calls have no effect.
  virtual void answer(const v1::RunStatus& reply) = 0;

  const char* const what;                   ///< requested operation for the log; null for read-only calls
  std::optional<std::uint64_t> until_step;  ///< the call is answered after this step
};

/// Method of the service with one request: its name, the right it requires, and its implementation.
template <typename Request>
struct ControlPanelSession::Kind {
  const char* what;
  Right right;
  void (ControlPanelSession::*request)(grpc::ServerContext*, Request*, grpc::ServerAsyncResponseWriter<v1::RunStatus>*,
                                       grpc::CompletionQueue*, grpc::ServerCompletionQueue*, void*);
  std::function<void(RunOperations&, const Request&, Call&)> execute;
};

template <typename Request>
class ControlPanelSession::PlainCall final : public UnarySession<Request, v1::RunStatus>, public Call {
 public:
  using Unary = UnarySession<Request, v1::RunStatus>;
  PlainCall(ControlPanelSession& owner, const Kind<Request>& kind)
      : Unary(owner.serving_, rulesFor(kind.right)), Call(kind.what), owner_(owner), kind_(kind) {}

  std::string logName() const override { return "control panel " + this->peer(); }
  ServerSession& session() override { return *this; }
  std::string details() const override { return detailsOf(this->request()); }
  void execute(RunOperations& operations) override { kind_.execute(operations, this->request(), *this); }
  void answer(const v1::RunStatus& reply) override { Unary::answer(reply); }

 private:
  void received(const Request& request) override {
    checkProtocol(request.protocol());
    this->establish();
    owner_.queue(std::static_pointer_cast<PlainCall>(this->shared_from_this()));
  }
  void runEnds() override {
    this->close(until_step ? errorStatus(v1::ERROR_REASON_STEPS_INTERRUPTED,
                                         "the run has ended before step " + std::to_string(*until_step))
                           : SessionHost::runIsOver());
  }

  ControlPanelSession& owner_;
  const Kind<Request> kind_;
};

/// Receives the pieces of a world. One load at a time is accepted, which bounds the memory used to one world.
class ControlPanelSession::LoadCall final : public StreamSession<v1::LoadRequest, v1::RunStatus>, public Call {
 public:
  explicit LoadCall(ControlPanelSession& owner) : StreamSession(owner.serving_, rules()), Call("load"), owner_(owner) {}

  bool is_complete = false;
  ServingState::Clock::time_point since;
  WorldPieces pieces;

  std::string logName() const override { return "control panel " + peer() + ": load"; }
  ServerSession& session() override { return *this; }
  std::string details() const override { return " " + world_; }
  void execute(RunOperations& operations) override {
    operations.replace(owner_.prepared_.get());
    v1::RunStatus status;
    operations.describe(status);
    world_ = status.world();
    operations.run_control.is_paused = true;
    operations.run_control.steps_left = 0;
  }
  void answer(const v1::RunStatus& reply) override {
    draft() = reply;
    post();
    close(grpc::Status::OK);
  }

 private:
  static SessionRules rules() {
    SessionRules rules = rulesFor(Right::operate);
    rules.may_send_more = true;  // a world is large
    return rules;
  }
  grpc::Status admit() override {
    if (!owner_.isLoading()) return grpc::Status::OK;
    return errorStatus(v1::ERROR_REASON_LOAD_IN_PROGRESS,
                       "the environment is loading a world for another call; load again when that is done");
  }
  ReadPolicy received(const v1::LoadRequest& piece) override {
    if (!isEstablished()) begin(piece);
    pieces.add(piece.piece());
    return ReadPolicy::immediate;
  }
  /// Makes this call the active load, on its first piece.
  void begin(const v1::LoadRequest& piece) {
    checkProtocol(piece.protocol());
    if (const auto status = admit(); !status.ok()) throw WireError(status);
    establish();
    since = owner_.serving_.now();
    owner_.load_ = std::static_pointer_cast<LoadCall>(shared_from_this());
  }
  void readsDone() override {
    if (isGone()) return;
    if (pieces.empty()) {
      disconnect(
          errorStatus(v1::ERROR_REASON_INVALID_MESSAGE, "no piece of a robosim.v1.WorldSource; see doc/protocol.md"));
      return;
    }
    is_complete = true;
    owner_.serving_.wake_requested = true;
  }
  void runEnds() override { close(SessionHost::runIsOver()); }

  ControlPanelSession& owner_;
  std::string world_;  ///< name of the loaded world
};

/// Stream of statuses to one control panel.
class ControlPanelSession::Watcher final : public StreamSession<v1::WatchRequest, v1::RunStatus> {
 public:
  explicit Watcher(ControlPanelSession& owner) : StreamSession(owner.serving_, rulesFor(Right::look)), owner_(owner) {}

  std::string logName() const override { return "control panel " + peer() + ": watch"; }

  ServingState::Clock::duration interval{};
  ServingState::Clock::time_point due;  ///< earliest time of the next status

 private:
  ReadPolicy received(const v1::WatchRequest& request) override {
    if (isEstablished()) throw WireError("a second request in one call");
    checkProtocol(request.protocol());
    interval = intervalOf(request);
    due = owner_.serving_.now();
    establish();
    owner_.watchers_.push_back(std::static_pointer_cast<Watcher>(shared_from_this()));
    owner_.serving_.wake_requested = true;
    return ReadPolicy::immediate;
  }
  /// The client has sent its one request.
  void readsDone() override {
    if (isEstablished() || isGone()) return;
    disconnect(errorStatus(v1::ERROR_REASON_INVALID_MESSAGE, "a call without a request; see doc/protocol.md"));
  }
  void left() override {
    std::erase_if(owner_.watchers_, [&](const auto& watcher) { return watcher.get() == this; });
  }

  ControlPanelSession& owner_;
};

ControlPanelSession::ControlPanelSession(ServingState& serving) : serving_(serving) {}
ControlPanelSession::~ControlPanelSession() = default;

void ControlPanelSession::open(const CompletionQueueServer::ServiceQueues& queues) {
  using Self = ControlPanelSession;
  serving_.serve(
      queues, [this] { return std::make_shared<LoadCall>(*this); },
      [this, load = indexOf("Load")](auto... arguments) {
        // A client-streaming call is, on the wire, a bidirectional one with one response.
        RequestAsyncBidiStreaming(load, arguments...);
      });
  serving_.serve(
      queues, [this] { return std::make_shared<Watcher>(*this); },
      [this, watch = indexOf("Watch")](auto... arguments) { RequestAsyncBidiStreaming(watch, arguments...); });
  const auto pause = [](bool is_paused) {
    return [is_paused](RunOperations& operations, const auto&, Call&) {
      operations.run_control.is_paused = is_paused;
      operations.run_control.steps_left = 0;
    };
  };
  serve<v1::StartRequest>(queues, {"start", Right::operate, &Self::RequestStart, pause(false)});
  serve<v1::PauseRequest>(queues, {"pause", Right::operate, &Self::RequestPause, pause(true)});
  serve<v1::StopRequest>(queues,
                         {"stop", Right::operate, &Self::RequestStop,
                          [](RunOperations& operations, const auto&, Call&) { operations.run_control.stop = true; }});
  serve<v1::GetStatusRequest>(
      queues, {nullptr, Right::look, &Self::RequestGetStatus, [](RunOperations&, const auto&, Call&) {}});
  serve<v1::StepRequest>(queues, {"step", Right::operate, &Self::RequestStep,
                                  [](RunOperations& operations, const v1::StepRequest& request, Call& call) {
                                    checkSteps(request.steps());
                                    operations.run_control.is_paused = true;
                                    operations.run_control.steps_left += request.steps();
                                    v1::RunStatus status;
                                    operations.describe(status);
                                    call.until_step = status.step() + operations.run_control.steps_left;
                                  }});
  serve<v1::SetSpeedRequest>(queues, {"speed", Right::operate, &Self::RequestSetSpeed,
                                      [this](RunOperations& operations, const v1::SetSpeedRequest& request, Call&) {
                                        checkSpeed(request.speed(), serving_.pace);
                                        operations.run_control.speed = request.speed();
                                      }});
  serve<v1::SetRecordingRequest>(queues, {"record", Right::operate, &Self::RequestSetRecording,
                                          [](RunOperations& operations, const v1::SetRecordingRequest& request, Call&) {
                                            setRecording(operations, request.on());
                                          }});
}

template <typename Request>
void ControlPanelSession::serve(const CompletionQueueServer::ServiceQueues& queues, const Kind<Request>& kind) {
  serving_.serve(
      queues, [this, kind] { return std::make_shared<PlainCall<Request>>(*this, kind); },
      [this, request = kind.request](auto... arguments) { (this->*request)(arguments...); });
}

void ControlPanelSession::queue(const std::shared_ptr<Call>& call) {
  calls_.push_back(call);
  serving_.wake_requested = true;
}

bool ControlPanelSession::isLoading() const { return prepared_.valid() || (load_ && !load_->isGone()); }

void ControlPanelSession::advanceLoad(RunOperations& operations) {
  if (!load_) return;
  if (!prepared_.valid()) {
    if (load_->isGone()) {
      load_.reset();
    } else if (load_->is_complete) {
      beginPreparing(operations);
    } else if (serving_.now() - load_->since >= serving_.load_deadline) {
      const auto s = std::chrono::duration_cast<std::chrono::seconds>(serving_.load_deadline).count();
      load_->close(errorStatus(
          v1::ERROR_REASON_LOAD_DEADLINE,
          "the world was not received within " + std::to_string(s) + " s; load it again over a faster connection"));
    }
    return;
  }
  if (!isPrepared()) return;
  const std::shared_ptr<LoadCall> call = std::exchange(load_, nullptr);
  execute(operations, *call);
  prepared_ = {};
}

void ControlPanelSession::beginPreparing(RunOperations& operations) {
  serving_.log("control panel " + load_->peer() + ": loads a world of " + std::to_string(load_->pieces.bytes()) +
               " bytes; the current run continues until it is built");
  const auto pieces = std::make_shared<WorldPieces>(std::move(load_->pieces));
  std::promise<std::unique_ptr<PreparedRun>> prepared;
  prepared_ = prepared.get_future();
  building_ = std::async(std::launch::async, [pieces, prepare = operations.prepare, prepared = std::move(prepared),
                                              queue_server = serving_.queue_server]() mutable {
    try {
      const WorldSource source = pieces->takeSource();
      prepared.set_value(prepare(source));
    } catch (...) {
      prepared.set_exception(std::current_exception());
    }
    queue_server->wake();
  });
}

bool ControlPanelSession::isPrepared() const {
  return prepared_.valid() && prepared_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void ControlPanelSession::execute(RunOperations& operations) {
  advanceLoad(operations);
  for (const auto& call : std::exchange(calls_, {})) {
    execute(operations, *call);
    if (call->until_step) steppers_.push_back(call);
  }
  answerSteppers(operations);
  for (const auto& watcher : watchers_) {
    if (serving_.now() < watcher->due || !watcher->isIdle()) continue;
    watcher->due = serving_.now() + watcher->interval;
    operations.describe(watcher->draft());
    watcher->post();
  }
}

void ControlPanelSession::execute(RunOperations& operations, Call& call) {
  ServerSession& session = call.session();
  if (session.isGone() || session.isCancelled()) return;
  // A load may have taken so long that its token is no longer valid.
  if (const auto status = session.permission(); !status.ok()) {
    session.disconnect(status);
    return;
  }
  try {
    call.execute(operations);
    if (call.what) serving_.audit.write(session.client(), session.peer(), call.what + call.details());
    if (call.until_step) return;
    v1::RunStatus reply;
    operations.describe(reply);
    call.answer(reply);
  } catch (const WireError& error) {
    refuse(call, error.status());
  } catch (const ConfigError& error) {  // in the world
    refuse(call, errorStatus(v1::ERROR_REASON_INVALID_WORLD, error.what()));
  } catch (const std::exception& error) {  // an error of the server itself, for example a full disk
    session.close(errorStatus(v1::ERROR_REASON_INTERNAL, "the run ends here: " + std::string(error.what())));
    throw;
  }
}

void ControlPanelSession::refuse(Call& call, const grpc::Status& status) {
  ServerSession& session = call.session();
  serving_.logRefusal("refused control panels", "control panel " + session.peer() + ": " +
                                                    (call.what ? call.what : "status") + ": " + status.error_message() +
                                                    serving_.tokenSuffix(session.client()));
  session.close(status);
}

void ControlPanelSession::answerSteppers(RunOperations& operations) {
  if (steppers_.empty()) return;
  v1::RunStatus status;
  operations.describe(status);
  std::erase_if(steppers_, [&](const auto& call) {
    if (call->session().isGone() || call->session().isCancelled()) return true;
    if (status.step() >= *call->until_step) {
      call->answer(status);
      return true;
    }
    if (operations.run_control.mayStep()) return false;
    call->session().close(
        errorStatus(v1::ERROR_REASON_STEPS_INTERRUPTED, "another control panel has paused the run at step " +
                                                            std::to_string(status.step()) + ", before step " +
                                                            std::to_string(*call->until_step)));
    return true;
  });
}

void ControlPanelSession::publishLast(RunOperations& operations) {
  for (const auto& watcher : watchers_) {
    operations.describe(watcher->draft());
    watcher->post();
  }
  calls_.clear();
  steppers_.clear();
  load_.reset();
}

}  // namespace robosim
