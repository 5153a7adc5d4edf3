#pragma once
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include <grpcpp/alarm.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/async_stream.h>

#include "net/completion_queue_server.h"
#include "net/wire_error.h"

namespace robosim {

/// When StreamCall reads the next message of a stream.
enum class ReadPolicy {
  immediate,  ///< at once
  /// At once, but at most kMaxMessagesPerPeriod times per kRatePeriod. gRPC does not poll other connections while a
  /// completed read is available, so a peer that sends continuously would starve the other clients.
  rate_limited,
  /// When the next message is written. HTTP/2's acknowledgement of the received message then shares a packet with the
  /// written one instead of waking the peer separately, and a peer cannot flood the server.
  after_write,
};

/// The server side of a bidirectional stream. Meets gRPC's requirements, whose violation would end the process: at most
/// one read and one write at a time, none after Finish(), and an object that lives until gRPC has completed all
/// operations. Calls after the end of the stream have no effect.
///
/// Messages are received as raw bytes and parsed here: for an unparsable message gRPC would only report the end of the
/// stream, and the peer would not receive a reason.
template <typename In, typename Out>
class StreamCall : public std::enable_shared_from_this<StreamCall<In, Out>> {
 public:
  using Wire = grpc::ServerAsyncReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer>;

  explicit StreamCall(CompletionQueueServer& queue_server) : registration_(queue_server) {}
  StreamCall(const StreamCall&) = delete;
  StreamCall& operator=(const StreamCall&) = delete;

  /// Requests a client's call. Call once, on an object created by make_shared.
  /// @param request is called with a ServerContext*, a Wire* and a tag, for a service's RequestX()
  template <typename Request>
  void await(const Request& request) {
    self_ = this->shared_from_this();
    context_.AsyncNotifyWhenDone(done_.tag());
    request(&context_, &wire_, called_.tag());
  }

  /// @name Sending
  /// Fill draft(), which keeps its previous content, then call post(). The message is written once the previous write
  /// has completed. draft() withdraws a posted message that has not been written yet.
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

  /// Ends the stream with a status. With status OK, a posted message is written first. With DEADLINE_EXCEEDED, a
  /// pending write is cancelled, because the peer may never read it; with any other error the status follows the
  /// pending write, and the call is cancelled after kStatusTimeout.
  void end(const grpc::Status& status) {
    if (ending_) return;
    ending_ = true;
    status_ = {status.error_code(), truncatedForStatus(status.error_message())};
    if (!status.ok()) {
      posted_ = false;
      has_cancel_timer_ = true;
      ++pending_;
      cancel_timer_.Set(registration_.queueServer().queue(), std::chrono::system_clock::now() + kStatusTimeout,
                        cancel_timer_over_.tag());
    }
    if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED && writing_) context_.TryCancel();
    writeNext();
  }

  const grpc::ServerContext& context() const { return context_; }
  const std::string& peer() const { return peer_; }  ///< address of the client; also valid after the end
  /// Whether the peer has cancelled the call or disconnected.
  bool isCancelled() const { return is_cancelled_; }

 protected:
  virtual ~StreamCall() = default;

  /// Called when a client has made the call; reading starts afterwards.
  virtual void called() = 0;
  /// Handles a message.
  /// @throws WireError for an invalid message; must not throw anything else.
  virtual ReadPolicy received(const In&) = 0;
  /// Called when the peer has sent its last message (half-close).
  virtual void readsDone() { end(grpc::Status::OK); }
  /// Disconnects a peer that sent an invalid message.
  virtual void refuse(const WireError&) = 0;
  /// Called last, after the end of the stream or the loss of the connection.
  virtual void ended() = 0;

 private:
  using Tag = MemberCompletionTag<StreamCall>;

  void writeNext() {
    if (writing_ || finished_) return;
    if (posted_) {
      posted_ = false;
      writing_ = has_written_since_read_ = true;
      bool owns_bytes = false;
      bytes_written_.Clear();
      grpc::SerializationTraits<Out>::Serialize(draft_, &bytes_written_, &owns_bytes);
      ++pending_;
      wire_.Write(bytes_written_, written_.tag());
      if (std::exchange(is_read_deferred_, false)) read();
    } else if (ending_) {
      finished_ = true;
      ++pending_;
      wire_.Finish(status_, finished_tag_.tag());
    }
  }

  void read() {
    if (finished_) return;
    ++pending_;
    wire_.Read(&bytes_read_, read_.tag());
  }

  void onCalled(bool ok) {
    if (!ok) {  // the server is shutting down
      const auto last = std::move(self_);
      return;
    }
    ++pending_;  // for onDone()
    peer_ = context_.peer();
    called();
    read();
  }

  void onRead(bool ok) {
    if (ok) {
      handleMessage();
    } else {
      readsDone();
    }
    completeOperation();
  }

  void handleMessage() {
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
      ++pending_;
      read_delay_.Set(registration_.queueServer().queue(), std::chrono::system_clock::now() + kRatePeriod,
                      read_delay_over_.tag());
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
    completeOperation();
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

  void onReadDelayOver(bool /*ok*/) {
    read();
    completeOperation();
  }

  void onCancelTimerOver(bool ok) {
    if (ok) context_.TryCancel();
    completeOperation();
  }

  /// The stream has ended, the connection was lost, or the peer has cancelled the call.
  void onDone(bool /*ok*/) {
    is_cancelled_ = context_.IsCancelled();
    if (is_cancelled_) end(grpc::Status::CANCELLED);
    completeOperation();
  }

  void onFinished(bool /*ok*/) {
    is_over_ = true;
    if (std::exchange(has_cancel_timer_, false)) cancel_timer_.Cancel();
    completeOperation();
  }

  /// Releases this object when no operation is pending and the stream is finished.
  void completeOperation() {
    if (--pending_ > 0 || !is_over_) return;
    ended();
    const auto last = std::move(self_);  // may hold the last reference, until this function returns
  }

  static constexpr std::chrono::seconds kStatusTimeout{1};
  static constexpr std::chrono::milliseconds kRatePeriod{1};
  static constexpr int kMaxMessagesPerPeriod = 4;

  CompletionQueueServer::CallRegistration registration_;
  std::shared_ptr<StreamCall> self_;
  grpc::ServerContext context_;
  std::string peer_;
  Wire wire_{&context_};
  grpc::Alarm cancel_timer_, read_delay_;
  Tag called_{*this, &StreamCall::onCalled}, read_{*this, &StreamCall::onRead}, written_{*this, &StreamCall::onWritten},
      cancel_timer_over_{*this, &StreamCall::onCancelTimerOver}, done_{*this, &StreamCall::onDone},
      finished_tag_{*this, &StreamCall::onFinished}, read_delay_over_{*this, &StreamCall::onReadDelayOver};
  grpc::ByteBuffer bytes_read_;
  In in_;
  Out draft_;
  grpc::ByteBuffer bytes_written_;
  CompletionQueueServer::Clock::time_point period_start_;
  int messages_in_period_ = 0;  ///< messages received since period_start_
  int pending_ = 0;             ///< operations that gRPC has not completed
  bool posted_ = false;         ///< the draft is to be written next
  bool writing_ = false;
  bool has_written_since_read_ = false;  ///< a write has started since the last message was received
  bool is_read_deferred_ = false;        ///< the next read starts with the next write
  bool ending_ = false;
  bool finished_ = false;  ///< Finish() was called
  bool is_over_ = false;   ///< Finish() has completed
  bool has_cancel_timer_ = false;
  bool is_cancelled_ = false;
  grpc::Status status_;
};

}  // namespace robosim
