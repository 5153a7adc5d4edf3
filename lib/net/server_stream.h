#pragma once
#include <memory>
#include <mutex>
#include <utility>

#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>

#include "net/wire_error.h"

namespace robosim {

/// What gRPC calls a two-way stream whose messages it leaves to us to read and write. It would only say that the
/// stream has ended where a message cannot be read, and the peer would never hear why.
using RawStream = grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>;

/// The environment's end of a two-way stream. gRPC calls it from threads of its own; this keeps what gRPC demands, or
/// else ends the process: one write at a time, none after the end, and an object that lives until gRPC has done with
/// it. Whoever else holds a stream may go on calling it after its end; nothing happens then.
template <typename In, typename Out>
class ServerStream : public RawStream, public std::enable_shared_from_this<ServerStream<In, Out>> {
 public:
  explicit ServerStream(grpc::CallbackServerContext* context) : context_(context) {}

  /// Call once it is fully made, by make_shared.
  void begin() {
    self_ = this->shared_from_this();
    StartRead(&bytes_read_);
  }

  /// @name Sending: one thread at a time
  /// Fill the draft, which stands as it was last left, then post it. It goes out once the write before it is done. A
  /// draft posted before that has not gone out yet is taken back.
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

  /// Whether nothing is posted or being written.
  bool isIdle() {
    const std::lock_guard lock(mutex_);
    return !posted_ && !writing_;
  }

  /// Ends the stream: what is posted still goes out if all is well. A peer that is too late may never take what is
  /// being written, and is cut off; any other is told the status after that.
  void end(const grpc::Status& status) {
    const std::lock_guard lock(mutex_);
    if (ending_) return;
    ending_ = true;
    status_ = {status.error_code(), fitForStatus(status.error_message())};
    if (!status.ok()) posted_ = false;
    if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED && writing_) context_->TryCancel();
    writeNext();
  }

 protected:
  ~ServerStream() override = default;

  /// A message came. Called from one of gRPC's threads, one message at a time.
  /// @throws WireError for one that makes no sense, and nothing else.
  virtual void received(const In&) = 0;
  /// Hangs up on a peer that sent what makes no sense.
  virtual void refuse(const WireError&) = 0;
  /// What was posted has gone out, and nothing more is posted.
  virtual void drained() {}
  /// The peer has hung up, or is lost. Followed by no other call.
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
        throw WireError("a message that is no " + in_.GetTypeName() + "; doc/protocol.md tells what is");
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
      if (!ok) {  // the peer is gone: there is nobody to write to
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
    const auto last = std::move(self_);  // may be the last to hold this, and ends with this function
  }

  std::shared_ptr<ServerStream> self_;
  grpc::CallbackServerContext* context_;
  grpc::ByteBuffer bytes_read_;
  In in_;
  std::mutex mutex_;
  Out draft_;
  grpc::ByteBuffer bytes_written_;
  bool posted_ = false;   ///< the draft is to be written next
  bool writing_ = false;  ///< between StartWrite and OnWriteDone
  bool ending_ = false;
  bool finished_ = false;
  grpc::Status status_;
};

}  // namespace robosim
