#pragma once
#include <utility>

#include <grpcpp/grpcpp.h>
#include <grpcpp/support/async_stream.h>

#include "net/server_session.h"

namespace robosim {

/// Session of a call with one request and a stream of replies. The call begins when gRPC has received its request.
template <typename Request, typename Reply>
class ServerStreamingSession : public ServerSession {
 public:
  /// Requests a client's call; called by SessionHost::serve().
  template <typename RequestMethod>
  void await(const CompletionQueueServer::ServiceQueues& queues, const RequestMethod& request_call) {
    context_.AsyncNotifyWhenDone(done_.tag());
    request_call(&context_, &request_, &wire_, queues.call_queue, queues.notification_queue, called_.tag());
  }

  /// @name Sending
  /// Fill draft(), then call post(). The reply is written once the previous write has completed. draft() withdraws a
  /// posted reply that has not been written yet. No effect after the end.
  ///@{
  Reply& draft() {
    posted_ = false;
    return draft_;
  }
  void post() {
    posted_ = true;
    writeNext();
  }
  ///@}

  /// Whether no reply is posted or being written.
  bool isIdle() const { return !posted_ && !writing_; }

 protected:
  using ServerSession::ServerSession;

  /// Handles the request; calls establish() to accept the client.
  /// @throws WireError for an invalid request; must not throw anything else.
  virtual void received(const Request&) = 0;

  /// Sends the final status. With status OK, a posted reply is written first.
  void end(const grpc::Status& status) final {
    if (std::exchange(ending_, true)) return;
    status_ = status;
    if (!status.ok()) posted_ = false;
    if (!status.ok() && writing_) context_.TryCancel();  // the peer may never read the pending reply
    writeNext();
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

  void writeNext() {
    if (writing_ || finished_) return;
    if (posted_) {
      posted_ = false;
      writing_ = true;
      startOperation();
      wire_.Write(draft_, written_.tag());
    } else if (ending_) {
      finished_ = true;
      startOperation();
      wire_.Finish(status_, finished_tag_.tag());
    }
  }

  void onWritten(bool ok) {
    writing_ = false;
    if (!ok) {  // the peer has disconnected
      posted_ = false;
      ending_ = true;
    }
    writeNext();
    completeOperation();
  }
  void onFinished(bool /*ok*/) { completeOperation(); }

  using Tag = MemberCompletionTag<ServerStreamingSession>;
  Request request_;
  Reply draft_;
  grpc::ServerAsyncWriter<Reply> wire_{&context_};
  Tag written_{*this, &ServerStreamingSession::onWritten}, finished_tag_{*this, &ServerStreamingSession::onFinished};
  bool posted_ = false;  ///< the draft is to be written next
  bool writing_ = false;
  bool ending_ = false;
  bool finished_ = false;  ///< Finish() was called
  grpc::Status status_;
};

}  // namespace robosim
