#pragma once
#include <memory>
#include <utility>

#include <grpcpp/grpcpp.h>
#include <grpcpp/support/async_unary_call.h>

#include "net/completion_queue_server.h"
#include "net/wire_error.h"

namespace robosim {

/// The server side of a unary call. Keeps itself alive until gRPC has completed all its operations.
template <typename Request, typename Reply>
class UnaryCall : public std::enable_shared_from_this<UnaryCall<Request, Reply>> {
 public:
  using Wire = grpc::ServerAsyncResponseWriter<Reply>;

  explicit UnaryCall(CompletionQueueServer& queue_server) : registration_(queue_server) {}
  UnaryCall(const UnaryCall&) = delete;
  UnaryCall& operator=(const UnaryCall&) = delete;

  /// Requests a client's call. Call once, on an object created by make_shared.
  /// @param request_call is called with a ServerContext*, a Request*, a Wire* and a tag, for a service's RequestX()
  template <typename RequestMethod>
  void await(const RequestMethod& request_call) {
    self_ = this->shared_from_this();
    context_.AsyncNotifyWhenDone(done_.tag());
    request_call(&context_, &request_, &wire_, called_.tag());
  }

  /// Sends the reply and ends the call. Further calls have no effect.
  void answer(const Reply& reply, const grpc::Status& status) {
    if (std::exchange(is_answered_, true)) return;
    ++pending_;
    wire_.Finish(reply, {status.error_code(), truncatedForStatus(status.error_message())}, answered_.tag());
  }

  const grpc::ServerContext& context() const { return context_; }
  const Request& request() const { return request_; }
  /// Whether the client has cancelled the call or disconnected.
  bool isCancelled() const { return is_cancelled_; }

 protected:
  virtual ~UnaryCall() = default;
  /// Called when a client has made the call.
  virtual void called() = 0;

 private:
  void onCalled(bool ok) {
    if (!ok) {  // the server is shutting down
      const auto last = std::move(self_);
      return;
    }
    ++pending_;  // for onDone()
    called();
  }
  void onDone(bool /*ok*/) {
    is_cancelled_ = context_.IsCancelled();
    if (is_cancelled_) answer({}, grpc::Status::CANCELLED);
    completeOperation();
  }
  void onAnswered(bool /*ok*/) { completeOperation(); }

  /// Releases this object when no operation is pending.
  void completeOperation() {
    if (--pending_ > 0) return;
    const auto last = std::move(self_);  // may hold the last reference, until this function returns
  }

  using Tag = MemberCompletionTag<UnaryCall>;
  CompletionQueueServer::CallRegistration registration_;
  std::shared_ptr<UnaryCall> self_;
  grpc::ServerContext context_;
  Request request_;
  Wire wire_{&context_};
  Tag called_{*this, &UnaryCall::onCalled}, done_{*this, &UnaryCall::onDone}, answered_{*this, &UnaryCall::onAnswered};
  int pending_ = 0;  ///< operations that gRPC has not completed
  bool is_answered_ = false;
  bool is_cancelled_ = false;
};

}  // namespace robosim
