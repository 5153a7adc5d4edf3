#pragma once
#include <chrono>
#include <utility>

#include <grpcpp/alarm.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/async_stream.h>

#include "net/server_session.h"

namespace robosim {

/// When StreamSession reads the next message of a stream.
enum class ReadPolicy {
  immediate,  ///< at once
  /// At once, but at most kMaxMessagesPerPeriod times per kRatePeriod. gRPC does not poll other connections while a
  /// completed read is available, so a peer that sends continuously would starve the other clients.
  rate_limited,
  /// When the next message is written. HTTP/2's acknowledgement of the received message then shares a packet with the
  /// written one instead of waking the peer separately, and a peer cannot flood the server.
  after_write,
};

/// Session of a bidirectional stream. Meets gRPC's requirements, whose violation would end the process: at most one
/// read and one write at a time, none after Finish(), and an object that lives until gRPC has completed all operations.
///
/// Messages are received as raw bytes and parsed here: for an unparsable message gRPC would only report the end of the
/// stream, and the peer would not receive a reason.
template <typename In, typename Out>
class StreamSession : public ServerSession {
 public:
  /// Requests a client's call; called by SessionHost::serve().
  template <typename Request>
  void await(const CompletionQueueServer::ServiceQueues& queues, const Request& request) {
    context_.AsyncNotifyWhenDone(done_.tag());
    request(&context_, &wire_, queues.call_queue, queues.notification_queue, called_.tag());
  }

  /// @name Sending
  /// Fill draft(), which keeps its previous content, then call post(). The message is written once the previous write
  /// has completed. draft() withdraws a posted message that has not been written yet. No effect after the end.
  ///@{
  Out& draft() {
    posted_ = false;
    return draft_;
  }
  void post() {
    posted_ = true;
    writeNext();
  }
  ///@}

  /// Whether no message is posted or being written.
  bool isIdle() const { return !posted_ && !writing_; }

 protected:
  using ServerSession::ServerSession;

  /// Handles a message; the first one calls establish() to accept the client.
  /// @throws WireError for an invalid message
  virtual ReadPolicy received(const In&) = 0;
  /// Called when the peer has sent its last message (half-close).
  virtual void readsDone() { end(grpc::Status::OK); }
  /// Called when all posted messages have been written.
  virtual void drained() {}

  /// Sends the final status. With status OK, a posted message is written first. With DEADLINE_EXCEEDED, a pending write
  /// is cancelled, because the peer may never read it; with any other error the status follows the pending write, and
  /// the call is cancelled after kStatusTimeout.
  void end(const grpc::Status& status) final {
    if (ending_) return;
    ending_ = true;
    status_ = status;
    if (!status.ok()) {
      posted_ = false;
      has_cancel_timer_ = true;
      startOperation();
      cancel_timer_.Set(queueServer().queue(), std::chrono::system_clock::now() + kStatusTimeout,
                        cancel_timer_over_.tag());
    }
    if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED && writing_) context_.TryCancel();
    writeNext();
  }

 private:
  using Tag = OperationTag<StreamSession>;

  void begun() final { read(); }

  void writeNext() {
    if (writing_ || finished_) return;
    if (posted_) {
      posted_ = false;
      writing_ = has_written_since_read_ = true;
      bool owns_bytes = false;
      bytes_written_.Clear();
      grpc::SerializationTraits<Out>::Serialize(draft_, &bytes_written_, &owns_bytes);
      startOperation();
      wire_.Write(bytes_written_, written_.tag());
      if (std::exchange(is_read_deferred_, false)) read();
    } else if (ending_) {
      finished_ = true;
      startOperation();
      wire_.Finish(status_, finished_tag_.tag());
    }
  }

  void read() {
    if (finished_) return;
    startOperation();
    wire_.Read(&bytes_read_, read_.tag());
  }

  void onRead(bool ok) {
    if (ok) {
      handleMessage();
    } else {
      readsDone();
    }
  }

  void handleMessage() {
    if (!mayReceive()) return;
    has_written_since_read_ = false;
    auto policy = ReadPolicy::immediate;
    try {
      if (!grpc::SerializationTraits<In>::Deserialize(&bytes_read_, &in_).ok()) {
        throw WireError("a message that is not a valid " + in_.GetTypeName() + "; see doc/protocol.md");
      }
      policy = received(in_);
    } catch (const WireError& error) {
      refuse(error);
    }
    if (policy == ReadPolicy::rate_limited && isOverRateLimit()) {
      startOperation();
      read_delay_.Set(queueServer().queue(), std::chrono::system_clock::now() + kRatePeriod, read_delay_over_.tag());
    } else if (policy == ReadPolicy::after_write && !has_written_since_read_) {
      is_read_deferred_ = true;
    } else {
      read();
    }
  }

  void onWritten(bool ok) {
    writing_ = false;
    if (!ok) {  // the peer has disconnected
      posted_ = false;
      ending_ = true;
    }
    writeNext();
    if (!writing_ && !ending_) drained();
  }

  /// Counts a message, and returns whether the rate limit is reached.
  bool isOverRateLimit() {
    const auto now = CompletionQueueServer::Clock::now();
    if (now - period_start_ >= kRatePeriod) {
      period_start_ = now;
      messages_in_period_ = 0;
    }
    return ++messages_in_period_ >= kMaxMessagesPerPeriod;
  }

  void onReadDelayOver(bool /*ok*/) { read(); }

  void onCancelTimerOver(bool ok) {
    if (ok) context_.TryCancel();
  }

  void onFinished(bool /*ok*/) {
    if (std::exchange(has_cancel_timer_, false)) cancel_timer_.Cancel();
  }

  static constexpr std::chrono::seconds kStatusTimeout{1};
  static constexpr std::chrono::milliseconds kRatePeriod{1};
  static constexpr int kMaxMessagesPerPeriod = 4;

  grpc::ServerAsyncReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer> wire_{&context_};
  grpc::Alarm cancel_timer_, read_delay_;
  Tag read_{*this, &StreamSession::onRead}, written_{*this, &StreamSession::onWritten},
      cancel_timer_over_{*this, &StreamSession::onCancelTimerOver}, finished_tag_{*this, &StreamSession::onFinished},
      read_delay_over_{*this, &StreamSession::onReadDelayOver};
  grpc::ByteBuffer bytes_read_;
  In in_;
  Out draft_;
  grpc::ByteBuffer bytes_written_;
  CompletionQueueServer::Clock::time_point period_start_;
  int messages_in_period_ = 0;  ///< messages received since period_start_
  bool posted_ = false;         ///< the draft is to be written next
  bool writing_ = false;
  bool has_written_since_read_ = false;  ///< a write has started since the last message was received
  bool is_read_deferred_ = false;        ///< the next read starts with the next write
  bool ending_ = false;
  bool finished_ = false;  ///< Finish() was called
  bool has_cancel_timer_ = false;
  grpc::Status status_;
};

}  // namespace robosim
