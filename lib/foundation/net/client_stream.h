#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <grpcpp/grpcpp.h>

#include "net/adaptive_polling.h"
#include "net/client_call.h"
#include "net/connect.h"

namespace robosim {

/// The client side of a bidirectional stream, which can be opened again after its end. One thread opens, reads and ends
/// it, and waits with AdaptivePolling. In the meantime, other threads may call cancel() and, one at a time, isWriting()
/// and, if that is false, write().
template <typename Out, typename In>
class ClientStream {
 public:
  using Wire = grpc::ClientAsyncReaderWriter<Out, In>;
  /// Starts a call: calls a stub's AsyncX() with its arguments.
  using Start = std::function<std::unique_ptr<Wire>(grpc::ClientContext*, grpc::CompletionQueue*, void*)>;
  enum class Event { received, written, ended };

  ClientStream(const ConnectOptions& options, Start start)
      : options_(options), cancellation_(own_cancellation_), start_(std::move(start)) {}
  /// @param cancellation shared with other calls of the client; must outlive this
  ClientStream(const ConnectOptions& options, CallCancellation& cancellation, Start start)
      : options_(options), cancellation_(cancellation), start_(std::move(start)) {}
  ~ClientStream() { close(); }
  ClientStream(const ClientStream&) = delete;
  ClientStream& operator=(const ClientStream&) = delete;

  /// Whether to poll for messages that arrive frequently (AdaptivePolling) instead of sleeping.
  void setAdaptivePolling(bool enabled) { polls_adaptively_ = enabled; }

  /// Starts a call, with the token in its metadata; closes the previous one.
  void open() {
    close();
    call_.emplace(options_, cancellation_);
    call_->wire = start_(&call_->client.context, &call_->queue, &call_->started);
    wait(call_->started);
  }
  bool isOpen() const { return call_.has_value(); }

  /// Waits until the previous write has completed, and starts to write a message.
  /// @return false when the stream has ended: finish() returns the reason
  bool write(const Out& message) {
    if (!wait(call_->written)) return false;
    call_->written.is_pending = true;
    call_->wire->Write(message, &call_->written);
    return true;
  }
  bool isWriting() const { return call_->written.is_pending; }
  /// Ends writing; the server may still send.
  void writesDone() {
    wait(call_->written);
    call_->written.is_pending = true;
    call_->wire->WritesDone(&call_->written);
  }

  /// Waits for a message. @return false when the stream has ended
  bool read(In& message) {
    startRead(message);
    return wait(call_->read);
  }
  /// Waits for a message or for the end of a write.
  /// @param message the same one until it has been received
  Event next(In& message) {
    startRead(message);
    while (call_->read.is_pending) {
      if (waitForAny() == &call_->written) return Event::written;
    }
    return call_->read.succeeded ? Event::received : Event::ended;
  }

  /// Waits for the end of the stream, and closes it. @return its status
  grpc::Status finish() {
    grpc::Status status;
    wait(call_->written);
    wait(call_->read);
    call_->finished.is_pending = true;
    call_->wire->Finish(&status, &call_->finished);
    wait(call_->finished);
    call_.reset();
    return status;
  }
  /// Ends a stream that should go on. @throws ConnectionError with its status, or that the run is over
  [[noreturn]] void fail() {
    const grpc::Status status = finish();
    throw ConnectionError(status.ok() ? grpc::Status(grpc::StatusCode::ABORTED, "the run is over") : status, options_);
  }
  /// Waits for the end of the stream. @throws ConnectionError unless its status is OK
  void finishOrThrow() {
    if (const grpc::Status status = finish(); !status.ok()) throw ConnectionError(status, options_);
  }
  /// Ends the stream and all later ones. Thread-safe.
  void cancel() { cancellation_.cancel(); }
  bool isCancelled() const { return cancellation_.isCancelled(); }
  /// Cancels the call, if there is one.
  void close() {
    if (!call_) return;
    call_->client.context.TryCancel();
    finish();
  }

 private:
  /// State of an asynchronous gRPC operation.
  struct Operation {
    std::atomic<bool> is_pending{false};  ///< started and not completed
    bool succeeded = true;
  };
  struct Call {
    Call(const ConnectOptions& options, CallCancellation& cancellation) : client(options, cancellation) {}
    ~Call() {
      queue.Shutdown();
      void* tag = nullptr;
      for (bool ok = false; queue.Next(&tag, &ok);) {
      }
    }

    ClientCall client;
    grpc::CompletionQueue queue;
    std::unique_ptr<Wire> wire;
    Operation started{.is_pending = true}, written, read, finished;
  };

  void startRead(In& message) {
    if (call_->read.is_pending.exchange(true)) return;
    call_->wire->Read(&message, &call_->read);
  }

  bool wait(const Operation& operation) {
    while (operation.is_pending) waitForAny();
    return operation.succeeded;
  }

  /// Waits for the completion of an operation.
  Operation* waitForAny() {
    void* tag = nullptr;
    bool ok = false;
    if (polls_adaptively_) {
      awaitEvent(call_->queue, polling_, gpr_inf_future(GPR_CLOCK_MONOTONIC), tag, ok);
    } else {
      call_->queue.Next(&tag, &ok);
    }
    auto* operation = static_cast<Operation*>(tag);
    operation->succeeded = ok;
    operation->is_pending = false;
    return operation;
  }

  const ConnectOptions options_;
  CallCancellation own_cancellation_;
  CallCancellation& cancellation_;
  const Start start_;
  AdaptivePolling polling_;
  bool polls_adaptively_ = true;
  std::optional<Call> call_;
};

}  // namespace robosim
