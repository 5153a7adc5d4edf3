#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/error_list.h"
#include "base/seconds.h"
#include "net/error_status.h"
#include "net/stream_session.h"
#include "net/unary_session.h"
#include "net/wire_error.h"
#include "server/control_panel_session.h"
#include "server/world_pieces.h"

namespace robosim {

/// @file
/// Calls of control panels, each a session with its client. ControlPanelSession executes them between steps.

inline SessionRules controlPanelRules(Right right) {
  return {.right = right, .log_kind = "refused control panels", .refused_word = "refused"};
}

/// Of the audit log.
constexpr std::size_t kAuditedChangeBytesMax = 300;

/// Parameters of a request for the audit log.
inline std::string detailsOf(const google::protobuf::Message&) { return ""; }
inline std::string detailsOf(const v1::StepRequest& request) { return " " + std::to_string(request.steps()); }
inline std::string detailsOf(const v1::SetSpeedRequest& request) {
  return request.speed() == 0 ? " max" : " " + std::to_string(request.speed());
}
inline std::string detailsOf(const v1::SetRecordingRequest& request) { return request.on() ? " on" : " off"; }
inline std::string detailsOf(const v1::SuperviseRequest& request) {
  return " " + request.change().substr(0, kAuditedChangeBytesMax);
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
      : Unary(owner.serving_, controlPanelRules(kind.right)), Call(kind.what), owner_(owner), kind_(kind) {}

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
    operations.replace(readyRun(operations));
    v1::RunStatus status;
    operations.describe(status);
    world_ = status.world();
    operations.run_control.pause(true);
  }
  void answer(const v1::RunStatus& reply) override {
    draft() = reply;
    post();
    close(grpc::Status::OK);
  }

 private:
  /// The run that has been built, ready to replace the present one.
  /// @throws ConfigError for an invalid world; WireError for any other failure, after which the present run continues
  std::unique_ptr<PreparedRun> readyRun(const RunOperations& operations) const {
    const auto refused = [](const std::string& why) {
      return WireError(
          errorStatus(v1::ERROR_REASON_INTERNAL, "the world cannot be loaded: " + why + "; the present run continues"));
    };
    try {
      auto next = owner_.prepared_.get();
      operations.make_ready(*next);
      return next;
    } catch (const ConfigError&) {
      throw;
    } catch (const WireError&) {  // an invalid message
      throw;
    } catch (const std::exception& error) {
      throw refused(error.what());
    } catch (...) {
      throw refused("an exception of an unknown type");
    }
  }
  static SessionRules rules() {
    SessionRules rules = controlPanelRules(Right::operate);
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
  explicit Watcher(ControlPanelSession& owner)
      : StreamSession(owner.serving_, controlPanelRules(Right::look)), owner_(owner) {}

  std::string logName() const override { return "control panel " + peer() + ": watch"; }

  ServingState::Clock::duration interval{};
  ServingState::Clock::time_point due;  ///< earliest time of the next status

 private:
  /// Shortest time between two statuses of a watcher: a status takes time proportional to the number of robots, on the
  /// thread that steps the run.
  static constexpr std::chrono::milliseconds kIntervalMin{50};

  /// Minimum time between two statuses of a watcher.
  static ServingState::Clock::duration readInterval(const v1::WatchRequest& request) {
    const double s = request.min_interval_s();
    if (!(s >= 0 && s <= 3600)) {
      throw WireError("a minimum interval of " + std::to_string(s) + " s; must lie in [0, 3600]");
    }
    return std::max<ServingState::Clock::duration>(kIntervalMin, fromSeconds(s));
  }

  ReadPolicy received(const v1::WatchRequest& request) override {
    if (isEstablished()) throw WireError("a second request in one call");
    checkProtocol(request.protocol());
    interval = readInterval(request);
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

}  // namespace robosim
