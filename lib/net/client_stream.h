#pragma once
#include <memory>

#include <grpcpp/grpcpp.h>

#include "net/adaptive_polling.h"
#include "net/connect.h"

namespace robosim {

/// The client side of a bidirectional stream that alternates writes and reads. As grpc::ClientReaderWriter, but waits
/// with AdaptivePolling.
template <typename Out, typename In>
class ClientStream {
 public:
  using Wire = grpc::ClientAsyncReaderWriter<Out, In>;

  /// Starts the call, with the token in its metadata.
  /// @param call is called with a ClientContext*, a CompletionQueue* and a tag, for a stub's AsyncX()
  template <typename Call>
  ClientStream(const ConnectOptions& options, const Call& call) {
    attachToken(context_, options);
    wire_ = call(&context_, &queue_, &called_);
    wait(called_);
  }
  /// Cancels the call unless finish() was called.
  ~ClientStream() {
    if (!is_over_) {
      context_.TryCancel();
      finish();
    }
    queue_.Shutdown();
    void* tag = nullptr;
    for (bool ok = false; queue_.Next(&tag, &ok);) {
    }
  }
  ClientStream(const ClientStream&) = delete;
  ClientStream& operator=(const ClientStream&) = delete;

  /// Writes a message after the previous write has completed. Errors are reported by read() and finish().
  void write(const Out& message) {
    wait(written_);
    written_.is_pending = true;
    wire_->Write(message, &written_);
  }
  /// @return false when the stream has ended
  bool read(In& message) {
    read_.is_pending = true;
    wire_->Read(&message, &read_);
    return wait(read_);
  }
  /// Waits for the end of the stream, and returns its status. Call once, after all other calls.
  grpc::Status finish() {
    grpc::Status status;
    wait(written_);
    finished_.is_pending = is_over_ = true;
    wire_->Finish(&status, &finished_);
    wait(finished_);
    return status;
  }

 private:
  /// State of an asynchronous gRPC operation.
  struct Operation {
    bool is_pending = false;  ///< started and not completed
    bool succeeded = false;
  };

  bool wait(const Operation& operation) {
    while (operation.is_pending) {
      void* tag = nullptr;
      bool ok = false;
      awaitEvent(queue_, polling_, gpr_inf_future(GPR_CLOCK_MONOTONIC), tag, ok);
      *static_cast<Operation*>(tag) = {.is_pending = false, .succeeded = ok};
    }
    return operation.succeeded;
  }

  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  AdaptivePolling polling_;
  std::unique_ptr<Wire> wire_;
  Operation called_{.is_pending = true}, written_, read_, finished_;
  bool is_over_ = false;
};

}  // namespace robosim
