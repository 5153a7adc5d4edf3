#pragma once
#include <memory>
#include <utility>

#include <grpcpp/grpcpp.h>
#include <grpcpp/support/async_unary_call.h>

#include "net/switchboard.h"
#include "net/wire_error.h"

namespace robosim {

/// The environment's end of a call with one request and one reply. It lives until gRPC has done with it.
template <typename Request, typename Reply>
class UnaryCall : public std::enable_shared_from_this<UnaryCall<Request, Reply>> {
 public:
  using Wire = grpc::ServerAsyncResponseWriter<Reply>;

  explicit UnaryCall(Switchboard& switchboard) : presence_(switchboard) {}
  UnaryCall(const UnaryCall&) = delete;
  UnaryCall& operator=(const UnaryCall&) = delete;

  /// Waits for a client's call. Call once it is fully made, by make_shared.
  /// @param ask is called with a ServerContext*, a Request*, a Wire* and a tag, for a service's RequestX()
  template <typename Ask>
  void await(const Ask& ask) {
    self_ = this->shared_from_this();
    context_.AsyncNotifyWhenDone(done_.tag());
    ask(&context_, &request_, &wire_, called_.tag());
  }

  /// To be called once; nothing happens when it is called again.
  void answer(const Reply& reply, const grpc::Status& status) {
    if (std::exchange(is_answered_, true)) return;
    ++pending_;
    wire_.Finish(reply, {status.error_code(), fitForStatus(status.error_message())}, answered_.tag());
  }

  const grpc::ServerContext& context() const { return context_; }
  const Request& request() const { return request_; }
  /// The client has given up, or is gone.
  bool isCancelled() const { return is_cancelled_; }

 protected:
  virtual ~UnaryCall() = default;
  /// A client has called.
  virtual void called() = 0;

 private:
  void onCalled(bool ok) {
    if (!ok) {  // nobody calls any more
      const auto last = std::move(self_);
      return;
    }
    ++pending_;  // for onDone()
    called();
  }
  void onDone(bool /*ok*/) {
    is_cancelled_ = context_.IsCancelled();
    if (is_cancelled_) answer({}, grpc::Status::CANCELLED);
    settle();
  }
  void onAnswered(bool /*ok*/) { settle(); }

  /// One thing less is pending.
  void settle() {
    if (--pending_ > 0) return;
    const auto last = std::move(self_);  // may be the last to hold this, and ends with this function
  }

  using Event = EventOf<UnaryCall>;
  Switchboard::Presence presence_;
  std::shared_ptr<UnaryCall> self_;
  grpc::ServerContext context_;
  Request request_;
  Wire wire_{&context_};
  Event called_{*this, &UnaryCall::onCalled}, done_{*this, &UnaryCall::onDone},
      answered_{*this, &UnaryCall::onAnswered};
  int pending_ = 0;  ///< what gRPC was asked to do and has not done
  bool is_answered_ = false;
  bool is_cancelled_ = false;
};

}  // namespace robosim
