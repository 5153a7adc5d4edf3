#include "server/control_panel_session.h"

#include <algorithm>
#include <exception>
#include <future>
#include <optional>
#include <system_error>
#include <utility>

#include "base/error_list.h"
#include "net/wire_error.h"
#include "server/control_panel_calls.h"
#include "server/world_pieces.h"

namespace robosim {
namespace {

/// Maximum size of the text of a change.
constexpr std::size_t kChangeBytesMax = 64 * 1024;

/// Index of a method in the service.
int indexOf(const char* method) {
  return v1::RunStatus::descriptor()->file()->FindServiceByName("ControlPanel")->FindMethodByName(method)->index();
}

void check(const std::string& fault) {
  if (!fault.empty()) throw WireError(fault);
}

void setRecording(RunOperations& operations, bool on) {
  try {
    operations.set_recording(on);
  } catch (const ConfigError& error) {  // not of the world
    throw WireError(errorStatus(v1::ERROR_REASON_RECORDING_UNAVAILABLE, error.what()));
  }
}

/// @throws WireError for an invalid or impossible change
void supervise(RunOperations& operations, const std::string& change, const std::string& author) {
  std::string fault;
  if (change.size() > kChangeBytesMax) {
    throw WireError("a change of " + std::to_string(change.size()) + " bytes; the most is " +
                    std::to_string(kChangeBytesMax));
  }
  try {
    fault = operations.intervene({author, parseChange(change, "change")});
  } catch (const ConfigError& error) {
    fault = error.what();
  }
  if (!fault.empty()) throw WireError(errorStatus(v1::ERROR_REASON_CHANGE_REFUSED, fault));
}

}  // namespace

WatchAsStream::WatchAsStream() {
  const int watch = indexOf("Watch");
  MarkMethodStreamed(watch, nullptr);
  MarkMethodRaw(watch);
}

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
    return [is_paused](RunOperations& operations, const auto&, Call&) { operations.run_control.pause(is_paused); };
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
                                    check(stepsFault(request.steps()));
                                    operations.run_control.step(request.steps());
                                    v1::RunStatus status;
                                    operations.describe(status);
                                    call.until_step = status.step() + operations.run_control.steps_left;
                                  }});
  serve<v1::SetSpeedRequest>(queues, {"speed", Right::operate, &Self::RequestSetSpeed,
                                      [this](RunOperations& operations, const v1::SetSpeedRequest& request, Call&) {
                                        check(speedFault(request.speed(), serving_.pace == Pace::realtime));
                                        operations.run_control.speed = request.speed();
                                      }});
  serve<v1::SetRecordingRequest>(queues, {"record", Right::operate, &Self::RequestSetRecording,
                                          [](RunOperations& operations, const v1::SetRecordingRequest& request, Call&) {
                                            setRecording(operations, request.on());
                                          }});
  serve<v1::SuperviseRequest>(queues, {"supervise", Right::supervise, &Self::RequestSupervise,
                                       [](RunOperations& operations, const v1::SuperviseRequest& request, Call& call) {
                                         supervise(operations, request.change(), call.session().client().name());
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
  const auto prepared = std::make_shared<std::promise<std::unique_ptr<PreparedRun>>>();
  prepared_ = prepared->get_future();
  try {
    building_ = std::async(std::launch::async,
                           [pieces, prepare = operations.prepare, prepared, queue_server = serving_.queue_server] {
                             try {
                               const WorldSource source = pieces->takeSource();
                               prepared->set_value(prepare(source));
                             } catch (...) {
                               prepared->set_exception(std::current_exception());
                             }
                             queue_server->wake();
                           });
  } catch (const std::system_error&) {  // no further thread
    prepared->set_exception(std::current_exception());
    serving_.wake_requested = true;
  }
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
    describe(operations, *watcher, watcher->draft());
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
    describe(operations, session, reply);
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

/// Fills in the status of the run for a client.
void ControlPanelSession::describe(const RunOperations& operations, const ServerSession& session,
                                   v1::RunStatus& status) const {
  operations.describe(status);
  status.set_may_operate(serving_.access.check(session.client(), Right::operate).ok());
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
  status.set_may_operate(true);  // stepping requires it
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
    describe(operations, *watcher, watcher->draft());
    watcher->post();
  }
  calls_.clear();
  steppers_.clear();
  load_.reset();
}

}  // namespace robosim
