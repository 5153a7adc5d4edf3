#pragma once
#include <memory>

#include <grpcpp/grpcpp.h>

#include "net/dial.h"
#include "net/lookout.h"

namespace robosim {

/// A client's end of a two-way stream, for one that says something, waits for what it is told, and says the next. It
/// does what gRPC's own blocking stream does, but looks out for messages that come soon.
template <typename Out, typename In>
class ClientStream {
 public:
  using Wire = grpc::ClientAsyncReaderWriter<Out, In>;

  /// Calls, showing the token.
  /// @param call is called with a ClientContext*, a CompletionQueue* and a tag, for a stub's AsyncX()
  template <typename Call>
  ClientStream(const DialOptions& options, const Call& call) {
    showToken(context_, options);
    wire_ = call(&context_, &queue_, &called_);
    wait(called_);
  }
  /// Hangs up, if that has not been done.
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

  /// Says it once what was said before is on its way. A stream that has broken says why when it is read.
  void write(const Out& message) {
    wait(written_);
    written_.is_due = true;
    wire_->Write(message, &written_);
  }
  /// @return false when the stream has ended
  bool read(In& message) {
    read_.is_due = true;
    wire_->Read(&message, &read_);
    return wait(read_);
  }
  /// Waits for the end, and why it is. To be called once, last of all.
  grpc::Status finish() {
    grpc::Status status;
    wait(written_);
    finished_.is_due = is_over_ = true;
    wire_->Finish(&status, &finished_);
    wait(finished_);
    return status;
  }

 private:
  /// Something that gRPC was asked to do.
  struct Deed {
    bool is_due = false;  ///< not done yet
    bool was_possible = false;
  };

  bool wait(const Deed& deed) {
    while (deed.is_due) {
      void* tag = nullptr;
      bool ok = false;
      awaitEvent(queue_, lookout_, gpr_inf_future(GPR_CLOCK_MONOTONIC), tag, ok);
      *static_cast<Deed*>(tag) = {.is_due = false, .was_possible = ok};
    }
    return deed.was_possible;
  }

  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  Lookout lookout_;
  std::unique_ptr<Wire> wire_;
  Deed called_{.is_due = true}, written_, read_, finished_;
  bool is_over_ = false;
};

}  // namespace robosim
