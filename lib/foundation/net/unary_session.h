#pragma once
#include <utility>

#include <grpcpp/grpcpp.h>
#include <grpcpp/support/async_unary_call.h>

#include "net/server_session.h"

namespace robosim {

/// Session of a unary call.
template <typename Request, typename Reply>
class UnarySession : public ServerSession {
 public:
  /// Requests a client's call; called by SessionHost::serve().
  template <typename RequestMethod>
  void await(const CompletionQueueServer::ServiceQueues& queues, const RequestMethod& request_call) {
    context_.AsyncNotifyWhenDone(done_.tag());
    request_call(&context_, &request_, &wire_, queues.call_queue, queues.notification_queue, called_.tag());
  }

  /// Replies, with status OK. No effect on a session that is gone.
  void answer(const Reply& reply) {
    reply_ = reply;
    close(grpc::Status::OK);
  }
  const Request& request() const { return request_; }

 protected:
  using ServerSession::ServerSession;

  /// Handles the request; calls establish() to accept the client.
  /// @throws WireError for an invalid request
  virtual void received(const Request&) = 0;

  void end(const grpc::Status& status) final {
    if (std::exchange(is_answered_, true)) return;
    startOperation();
    wire_.Finish(reply_, status, answered_.tag());
  }

 private:
  void begun() final {
    if (isGone()) return;
    try {
      received(request_);
    } catch (const WireError& error) {
      refuse(error);
    }
  }
  void onAnswered(bool /*ok*/) {}

  using Tag = OperationTag<UnarySession>;
  Request request_;
  Reply reply_;
  grpc::ServerAsyncResponseWriter<Reply> wire_{&context_};
  Tag answered_{*this, &UnarySession::onAnswered};
  bool is_answered_ = false;
};

}  // namespace robosim
