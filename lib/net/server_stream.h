#pragma once
#include <memory>
#include <mutex>
#include <utility>

#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>

#include "net/wire_error.h"

namespace robosim {

/// Bidirectional stream of raw bytes; ServerStream parses the messages. For an unparsable message gRPC would only
/// report the end of the stream, and the peer would not receive a reason.
using RawStream = grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>;

/// The server side of a bidirectional stream with gRPC's callback API, called from gRPC's threads. Meets gRPC's
/// requirements, whose violation would end the process: at most one write at a time, none after Finish(), and an object
/// that lives until OnDone(). Calls after the end of the stream have no effect.
template <typename In, typename Out>
class ServerStream : public RawStream, public std::enable_shared_from_this<ServerStream<In, Out>> {
 public:
  explicit ServerStream(grpc::CallbackServerContext* context) : context_(context) {}

  /// Starts reading. Call once, on an object created by make_shared.
  void begin() {
    self_ = this->shared_from_this();
    StartRead(&bytes_read_);
  }

  /// @name Sending: one thread at a time
  /// Fill draft(), which keeps its previous content, then call post(). The message is written once the previous write
  /// has completed. draft() withdraws a posted message that has not been written yet.
  ///@{
  Out& draft() {
    const std::lock_guard lock(mutex_);
    posted_ = false;
    return draft_;
  }
  void post() {
    const std::lock_guard lock(mutex_);
    posted_ = true;
    writeNext();
  }
  ///@}

  /// Whether no message is posted or being written.
  bool isIdle() {
    const std::lock_guard lock(mutex_);
    return !posted_ && !writing_;
  }

  /// Ends the stream with a status. With status OK, a posted message is written first. With DEADLINE_EXCEEDED, a
  /// pending write is cancelled, because the peer may never read it; with any other error the status follows the
  /// pending write.
  void end(const grpc::Status& status) {
    const std::lock_guard lock(mutex_);
    if (ending_) return;
    ending_ = true;
    status_ = {status.error_code(), truncatedForStatus(status.error_message())};
    if (!status.ok()) posted_ = false;
    if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED && writing_) context_->TryCancel();
    writeNext();
  }

 protected:
  ~ServerStream() override = default;

  /// Handles a message. Called from one of gRPC's threads, one message at a time.
  /// @throws WireError for an invalid message; must not throw anything else.
  virtual void received(const In&) = 0;
  /// Disconnects a peer that sent an invalid message.
  virtual void refuse(const WireError&) = 0;
  /// Called when all posted messages have been written.
  virtual void drained() {}
  /// Called last, after the end of the stream or the loss of the connection.
  virtual void ended() = 0;

  grpc::CallbackServerContext* context() const { return context_; }

 private:
  /// @pre holds the mutex
  void writeNext() {
    if (writing_ || finished_) return;
    if (posted_) {
      posted_ = false;
      writing_ = true;
      bool owns_bytes = false;
      bytes_written_.Clear();
      grpc::SerializationTraits<Out>::Serialize(draft_, &bytes_written_, &owns_bytes);
      StartWrite(&bytes_written_);
    } else if (ending_) {
      finished_ = true;
      Finish(status_);
    }
  }

  void OnReadDone(bool ok) final {
    if (!ok) {
      end(grpc::Status::OK);
      return;
    }
    try {
      if (!grpc::SerializationTraits<In>::Deserialize(&bytes_read_, &in_).ok()) {
        throw WireError("a message that is not a valid " + in_.GetTypeName() + "; see doc/protocol.md");
      }
      received(in_);
    } catch (const WireError& error) {
      refuse(error);
    }
    const std::lock_guard lock(mutex_);
    if (!finished_) StartRead(&bytes_read_);
  }

  void OnWriteDone(bool ok) final {
    {
      const std::lock_guard lock(mutex_);
      writing_ = false;
      if (!ok) {  // the peer has disconnected
        posted_ = false;
        ending_ = true;
      }
      writeNext();
      if (writing_ || ending_) return;
    }
    drained();
  }

  void OnDone() final {
    ended();
    const auto last = std::move(self_);  // may hold the last reference, until this function returns
  }

  std::shared_ptr<ServerStream> self_;
  grpc::CallbackServerContext* context_;
  grpc::ByteBuffer bytes_read_;
  In in_;
  std::mutex mutex_;
  Out draft_;
  grpc::ByteBuffer bytes_written_;
  bool posted_ = false;   ///< the draft is written next
  bool writing_ = false;  ///< between StartWrite and OnWriteDone
  bool ending_ = false;
  bool finished_ = false;
  grpc::Status status_;
};

}  // namespace robosim
