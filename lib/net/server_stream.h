#pragma once
#include <memory>
#include <mutex>
#include <utility>

#include <grpcpp/grpcpp.h>

namespace robosim {

/// The environment's end of a two-way stream. gRPC calls it from threads of its own; this keeps what gRPC demands, or
/// else ends the process: one write at a time, none after the end, and an object that lives until gRPC has done with
/// it. Whoever else holds a stream may go on calling it after its end; nothing happens then.
template <typename In, typename Out>
class ServerStream : public grpc::ServerBidiReactor<In, Out>,
                     public std::enable_shared_from_this<ServerStream<In, Out>> {
 public:
  explicit ServerStream(grpc::CallbackServerContext* context) : context_(context) {}

  /// Call once it is fully made, by make_shared.
  void begin() {
    self_ = this->shared_from_this();
    this->StartRead(&in_);
  }

  /// @name Sending: one thread at a time
  /// Fill the draft, then post it. It goes out once the write before it is done. A draft posted before that has not
  /// gone out yet is taken back, and stands in the draft as it was.
  ///@{
  Out& draft() {
    const std::lock_guard lock(mutex_);
    posted_ = false;
    return *draft_;
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

  /// Ends the stream: what is posted still goes out if all is well, and a peer that does not take what is being written
  /// is cut off if not.
  void end(const grpc::Status& status) {
    const std::lock_guard lock(mutex_);
    if (ending_) return;
    ending_ = true;
    status_ = status;
    if (!status.ok()) {
      posted_ = false;
      if (writing_) context_->TryCancel();
    }
    writeNext();
  }

 protected:
  ~ServerStream() override = default;

  /// A message came. Called from one of gRPC's threads, one message at a time. What it throws must be caught inside.
  virtual void received(const In&) = 0;
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
      std::swap(draft_, being_written_);
      this->StartWrite(being_written_.get());
    } else if (ending_) {
      finished_ = true;
      this->Finish(status_);
    }
  }

  void OnReadDone(bool ok) final {
    if (!ok) {
      end(grpc::Status::OK);
      return;
    }
    received(in_);
    const std::lock_guard lock(mutex_);
    if (!finished_) this->StartRead(&in_);
  }

  void OnWriteDone(bool ok) final {
    const std::lock_guard lock(mutex_);
    writing_ = false;
    if (!ok) {  // the peer is gone: there is nobody to write to
      posted_ = false;
      ending_ = true;
    }
    writeNext();
  }

  void OnDone() final {
    ended();
    const auto last = std::move(self_);  // may be the last to hold this, and ends with this function
  }

  std::shared_ptr<ServerStream> self_;
  grpc::CallbackServerContext* context_;
  In in_;
  std::mutex mutex_;
  std::unique_ptr<Out> draft_ = std::make_unique<Out>();
  std::unique_ptr<Out> being_written_ = std::make_unique<Out>();
  bool posted_ = false;   ///< the draft is to be written next
  bool writing_ = false;  ///< between StartWrite and OnWriteDone
  bool ending_ = false;
  bool finished_ = false;
  grpc::Status status_;
};

}  // namespace robosim
