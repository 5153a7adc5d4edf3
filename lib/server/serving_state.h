#pragma once
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/log_limiter.h"
#include "net/access.h"
#include "net/audit.h"
#include "net/completion_queue_server.h"
#include "server/run_info.h"

namespace robosim {

/// Synchronisation of the environment's steps with its robots.
enum class Pace {
  lockstep,  ///< each step waits for every robot's command: the run is reproducible
  realtime,  ///< steps are taken at fixed times; a late robot keeps its last command
};

/// State shared by all sessions of one server. Used only by the thread that steps the environment.
struct ServingState {
  using Clock = std::chrono::steady_clock;

  /// Maximum duration of one wait. An interrupt does not end a wait, so that longer waits are split.
  static constexpr std::chrono::milliseconds kPollInterval{50};

  std::function<void(const std::string&)> log;               ///< receives one line
  std::function<bool()> interrupted = [] { return false; };  ///< whether the server is to end
  Clock::duration step_deadline;
  Clock::duration hello_deadline;
  Clock::duration load_deadline;  ///< maximum time for a control panel to send a world
  std::function<Clock::time_point()> now;
  Pace pace = Pace::lockstep;
  Access access;
  bool is_over = false;                           ///< all calls have been ended; new ones are refused
  std::shared_ptr<const RunInfo> run_info;        ///< never null once the server listens
  CompletionQueueServer* queue_server = nullptr;  ///< never null once the server listens
  bool wake_requested = false;  ///< a request is pending that is executed between steps; ends the wait

  /// Authenticates a call and checks that its client has a right; to be checked first.
  /// @param client receives the client's identity, if the result is OK
  grpc::Status authorizeCall(const grpc::ServerContextBase& call, Right right, Identity& client) const {
    auto [status, identity] = access.authenticate(call);
    if (status.ok()) status = access.check(identity, right);
    client = std::move(identity);
    return status.ok() && is_over ? runIsOver() : status;
  }
  /// ", with the token NAME" for a log line; empty where no tokens are required.
  std::string tokenSuffix(const Identity& client) const {
    return access.isOpen() ? "" : ", with the token " + client.name();
  }
  static grpc::Status runIsOver() { return {grpc::StatusCode::UNAVAILABLE, "the run is over"}; }

  /// Logs the refusal of a client, rate-limited, since a client may reconnect repeatedly.
  /// @param kind category that shares a rate limit
  void logRefusal(const std::string& line, std::string_view kind = "refused clients") { limited_log.write(kind, line); }

  /// Processes client events until `is_done` returns true, for at most `timeout` and kPollInterval.
  void pollUntil(Clock::duration timeout, const std::function<bool()>& is_done) const {
    const auto wait = std::clamp<Clock::duration>(timeout, Clock::duration::zero(), kPollInterval);
    queue_server->waitUntil(CompletionQueueServer::Clock::now() + wait, is_done);
  }

  LogLimiter limited_log{[this](const std::string& line) { log(line); }, [this] { return now(); }};
  AuditLog audit{[this](const std::string& line) { log(line); }, [this] { return now(); }};
};

}  // namespace robosim
