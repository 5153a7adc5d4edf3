#pragma once
#include <exception>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <string_view>

#include <grpcpp/grpcpp.h>

#include "net/flood_guard.h"
#include "net/session_host.h"
#include "net/wire_error.h"

namespace robosim {

/// What distinguishes the calls of one kind of client.
struct SessionRules {
  Right right;                ///< required for the whole call
  std::string_view log_kind;  ///< category of the rate-limited log lines, for example "refused viewers"
  std::string_view refused_word = "disconnected";    ///< in these lines
  std::string_view first_message = "first message";  ///< its name in the text of the deadline
  bool reports_each = false;   ///< whether an established client's disconnection is logged without a rate limit
  bool may_send_more = false;  ///< whether a client may send more than it receives (flood_guard)
};

/// Tag of a gRPC operation of a session. Any exception of the handler ends the call (ServerSession::complete()).
template <typename Session>
class OperationTag final : public CompletionTag {
 public:
  OperationTag(Session& session, void (Session::*then)(bool ok)) : session_(session), then_(then) {}
  void onCompletion(bool ok) override;

 private:
  Session& session_;
  void (Session::*then_)(bool);
};

/// Server side of one call, independent of the kind of call: StreamSession and UnarySession derive from it. A call is
///
/// 1. admitted when its client's token grants permission() and admit() agrees,
/// 2. established when its first message is accepted, within SessionHost::hello_deadline,
/// 3. gone after disconnect() or close(), or when the client has left.
///
/// The host owns a session until gRPC has completed all its operations.
class ServerSession : public std::enable_shared_from_this<ServerSession> {
 public:
  virtual ~ServerSession() = default;
  ServerSession(const ServerSession&) = delete;
  ServerSession& operator=(const ServerSession&) = delete;

  /// Ends the call, and logs the reason. No effect on a session that is gone.
  void disconnect(const grpc::Status& status);
  /// Ends the call without a log line. No effect on a session that is gone.
  void close(const grpc::Status& status);

  bool isEstablished() const { return state_ == State::established; }
  bool isGone() const { return state_ == State::gone; }
  /// Whether the client has cancelled the call or has disconnected.
  bool isCancelled() const { return is_cancelled_; }
  const Identity& client() const { return client_; }
  const std::string& peer() const { return peer_; }  ///< address of the client

  /// Name of the client for log lines.
  virtual std::string logName() const = 0;
  /// Whether the client's token currently permits the call; checked at the call, at its first message, and when tokens
  /// change.
  virtual grpc::Status permission() const { return host_.access.check(client_, rules_.right); }

 protected:
  ServerSession(SessionHost& host, const SessionRules& rules);

  /// Accepts the client, on its first message.
  void establish();

  /// @name Handlers of events
  /// An exception other than WireError ends the call with ERROR_REASON_INTERNAL and is logged; the server continues.
  ///@{
  /// Whether the call is accepted, apart from the client's rights.
  virtual grpc::Status admit() { return grpc::Status::OK; }
  /// Disconnects a client that sent an invalid message.
  virtual void refuse(const WireError& error) { disconnect(error.status()); }
  /// Called when an established client has left by itself, before left().
  virtual void hasLeft();
  /// Called once when an established session becomes gone.
  virtual void left() {}
  /// Closes the call because the run is over.
  virtual void runEnds() { close(isEstablished() ? grpc::Status::OK : SessionHost::runIsOver()); }
  ///@}

  /// @name For the kinds of calls
  ///@{
  /// Sends the final status; later calls have no effect.
  virtual void end(const grpc::Status& status) = 0;
  /// Called when a client has made the call and has been admitted or disconnected.
  virtual void begun() = 0;
  /// Whether a message of the client may be handled.
  bool mayReceive();
  void startOperation() { ++pending_; }
  /// Handles the completion of an operation that startOperation() has counted. Releases this object when gRPC has
  /// completed all operations, which it does last for the end of the call.
  template <typename Handler>
  void complete(const Handler& handler) {
    const Completion completion{*this};
    endCallOnException(handler);
  }
  CompletionQueueServer& queueServer() const { return registration_.queueServer(); }

  SessionHost& host_;
  grpc::ServerContext context_;
  MemberCompletionTag<ServerSession> called_{*this, &ServerSession::onCalled};
  OperationTag<ServerSession> done_{*this, &ServerSession::onDone};
  ///@}

 private:
  friend class SessionHost;
  template <typename Session>
  friend class OperationTag;
  /// Completes an operation at the end of a scope.
  struct Completion {
    ServerSession& session;
    ~Completion() { session.completeOperation(); }
  };
  enum class State { requested, awaiting_first_message, established, gone };

  void onCalled(bool ok);
  void onDone(bool ok);
  void authorize();
  void leave();
  void release();
  void completeOperation();
  /// Calls a handler; logs any exception. @return whether there was none
  template <typename Handler>
  bool logException(const Handler& handler) {
    try {
      handler();
      return true;
    } catch (const std::exception& error) {
      writeException(error.what());
    } catch (...) {
      writeException("an exception of an unknown type");
    }
    return false;
  }
  void writeException(const char* what);
  template <typename Handler>
  void endCallOnException(const Handler& handler) {
    if (!logException(handler)) endAfterException();
  }
  void endAfterException();

  const SessionRules rules_;
  CompletionQueueServer::CallRegistration registration_;
  State state_ = State::requested;
  Identity client_;
  std::string peer_;
  flood_guard::Exemption exemption_;
  std::function<void()> await_next_;  ///< requests the next call of the method
  SessionHost::Clock::time_point since_;
  std::list<std::shared_ptr<ServerSession>>::iterator position_;  ///< in the host's list
  int pending_ = 0;                                               ///< operations that gRPC has not completed
  bool is_cancelled_ = false;
};

template <typename Session>
void OperationTag<Session>::onCompletion(bool ok) {
  static_cast<ServerSession&>(session_).complete([&] { (session_.*then_)(ok); });
}

}  // namespace robosim
