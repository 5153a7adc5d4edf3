#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <grpcpp/grpcpp.h>

#include "base/log_limiter.h"
#include "net/access.h"
#include "net/audit.h"
#include "net/completion_queue_server.h"

namespace robosim {

class ServerSession;

/// Owner of the sessions of one server (ServerSession), and what they share: the clients' rights, the deadline for the
/// first message of a call, the log, and shutdown. Used by the thread that polls the queue server, or with its mutex
/// locked.
class SessionHost {
 public:
  using Clock = std::chrono::steady_clock;

  SessionHost() = default;
  SessionHost(const SessionHost&) = delete;
  SessionHost& operator=(const SessionHost&) = delete;

  std::function<void(const std::string&)> log = [](const std::string&) {};  ///< receives one line
  std::function<Clock::time_point()> now = Clock::now;
  Access access;
  Clock::duration hello_deadline = std::chrono::seconds(10);  ///< maximum time from a call to its first message
  CompletionQueueServer* queue_server = nullptr;              ///< not null when serve() is called
  bool is_over = false;                                       ///< all calls have been ended; new ones are refused

  /// Serves a method of a service: creates a session for each call.
  /// @param make returns a shared_ptr of a new session
  /// @param request calls the service's RequestX() with its arguments
  template <typename Make, typename Request>
  void serve(const CompletionQueueServer::ServiceQueues& queues, const Make& make, const Request& request) {
    const auto session = make();
    adopt(session, [this, queues, make, request] { serve(queues, make, request); });
    session->await(queues, request);
  }

  /// Disconnects the clients whose token no longer permits their call, and those whose first message is overdue;
  /// reports suppressed log lines. Call often.
  void checkSessions();
  /// Time at which the next first message is due; Clock::time_point::max() when none is awaited.
  Clock::time_point nextDeadline() const;
  /// Ends all calls, because the run is over, and refuses later ones.
  void endSessions();

  /// ", with the token NAME" for a log line; empty where no tokens are required.
  std::string tokenSuffix(const Identity& client) const;
  static grpc::Status runIsOver();
  /// Logs the refusal of a client, rate-limited, since a client may reconnect repeatedly.
  /// @param kind category that shares a rate limit
  void logRefusal(std::string_view kind, const std::string& line) { limited_log.write(kind, line); }

  LogLimiter limited_log{[this](const std::string& line) { log(line); }, [this] { return now(); }};
  AuditLog audit{[this](const std::string& line) { log(line); }, [this] { return now(); }};

 private:
  friend class ServerSession;
  using Sessions = std::list<std::shared_ptr<ServerSession>>;

  void adopt(const std::shared_ptr<ServerSession>& session, std::function<void()> await_next);
  std::vector<std::shared_ptr<ServerSession>> calls() const;  ///< that have begun

  Sessions handshakes_;               ///< awaiting their first message, in the order of their calls
  Sessions others_;                   ///< requested, established or ending
  std::uint64_t access_version_ = 0;  ///< at the last checkSessions()
};

}  // namespace robosim
