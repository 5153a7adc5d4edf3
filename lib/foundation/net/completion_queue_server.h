#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <grpcpp/alarm.h>
#include <grpcpp/grpcpp.h>

#include "net/adaptive_polling.h"
#include "net/open_port.h"

namespace robosim {

/// Tag of an asynchronous gRPC operation. CompletionQueueServer calls onCompletion() when the operation completes.
class CompletionTag {
 public:
  virtual ~CompletionTag() = default;
  /// @param ok whether the operation succeeded
  virtual void onCompletion(bool ok) = 0;
  void* tag() { return this; }
};

/// A CompletionTag that calls a member function of its owner.
template <typename Owner>
class MemberCompletionTag final : public CompletionTag {
 public:
  MemberCompletionTag(Owner& owner, void (Owner::*then)(bool)) : owner_(owner), then_(then) {}
  void onCompletion(bool ok) override { (owner_.*then_)(ok); }

 private:
  Owner& owner_;
  void (Owner::*then_)(bool);
};

/// Serves gRPC services on one or more ports with completion queues. All handlers run inside waitUntil() on the calling
/// thread, so the thread that steps the environment serves its clients between two steps without locks. gRPC's callback
/// API uses threads of its own and costs three more context switches per message (doc/decisions/grpc.md).
class CompletionQueueServer {
 public:
  using Clock = std::chrono::steady_clock;

  /// A service and the address at which it is served.
  struct Binding {
    std::string address;     ///< "host:port"; port 0 lets the system choose
    grpc::Service* service;  ///< must outlive this
  };
  /// Arguments of a service's generated RequestX() functions.
  struct ServiceQueues {
    CompletionQueueServer* queue_server;
    grpc::CompletionQueue* call_queue;                ///< receives the completions of a call's operations
    grpc::ServerCompletionQueue* notification_queue;  ///< receives new calls
  };

  /// Opens the ports; equal addresses share a port.
  /// @throws std::runtime_error with the address and how to fix it when a port is in use.
  CompletionQueueServer(const std::vector<Binding>& bindings, const PortOptions& options);
  ~CompletionQueueServer();
  CompletionQueueServer(const CompletionQueueServer&) = delete;
  CompletionQueueServer& operator=(const CompletionQueueServer&) = delete;

  int port(std::size_t binding) const { return endpoints_[endpoint_of_binding_[binding]].port.number; }
  ServiceQueues queuesFor(std::size_t binding);
  grpc::CompletionQueue* queue() const { return endpoints_.front().queue.get(); }

  /// Handles events until `is_enough` returns true or the deadline has passed. Events that are already due may be
  /// handled in either case.
  void waitUntil(Clock::time_point until, const std::function<bool()>& is_enough);
  /// Whether waitUntil() may poll for events (AdaptivePolling) instead of sleeping.
  void setAdaptivePolling(bool enabled) { polls_adaptively_ = enabled; }
  /// Locks a mutex while a handler runs, for a server whose calls are also used by another thread.
  void setMutex(std::mutex* mutex) { mutex_ = mutex; }
  /// Makes waitUntil() check `is_enough`. Thread-safe; without effect after close().
  void wake();

  /// Accepts no more calls, and waits until the open calls have ended; cancels them after 1 s. Abandons, with a line in
  /// the log, those that have not ended after `at_most`, which only a fault of this program can cause.
  void close(Clock::duration at_most = std::chrono::seconds(10));

  /// Registration of a requested or open call; close() waits until all registrations are destroyed. A registration may
  /// outlive the server only if close() has abandoned its call.
  class CallRegistration {
   public:
    explicit CallRegistration(CompletionQueueServer& queue_server)
        : queue_server_(queue_server), calls_(queue_server.calls_) {
      ++*calls_;
    }
    ~CallRegistration() { --*calls_; }
    CallRegistration(const CallRegistration&) = delete;
    CallRegistration& operator=(const CallRegistration&) = delete;
    CompletionQueueServer& queueServer() const { return queue_server_; }

   private:
    CompletionQueueServer& queue_server_;
    const std::shared_ptr<std::size_t> calls_;  ///< shared, because an abandoned call may outlive the server
  };

 private:
  struct Endpoint {
    std::string address;
    std::unique_ptr<grpc::ServerCompletionQueue> queue;
    OpenPort port;
  };
  void woke(bool ok);
  void waitForEvent(gpr_timespec until);
  void handle(void* tag, bool ok);
  bool handleNext(grpc::ServerCompletionQueue& queue);
  void handleSecondaryEvents();
  void pollAll();

  std::vector<Endpoint> endpoints_;               ///< the first one's queue is that of all calls
  std::vector<std::size_t> endpoint_of_binding_;  ///< by binding
  std::shared_ptr<std::size_t> calls_ = std::make_shared<std::size_t>(0);  ///< number of registrations
  std::mutex* mutex_ = nullptr;
  std::mutex wake_mutex_;  ///< guards the next two members
  bool is_wake_pending_ = false;
  bool accepts_wakes_ = true;
  MemberCompletionTag<CompletionQueueServer> wake_tag_{*this, &CompletionQueueServer::woke};
  grpc::Alarm wake_alarm_;
  bool polls_adaptively_ = true;
  AdaptivePolling polling_;
  Clock::time_point last_poll_;
  bool is_closed_ = false;
};

}  // namespace robosim
