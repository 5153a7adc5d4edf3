#pragma once
#include <mutex>

#include <grpcpp/grpcpp.h>

#include "net/connect.h"

namespace robosim {

/// Ends the calls of a client from another thread: the current one, and all later ones. Thread-safe.
class CallCancellation {
 public:
  void cancel();
  bool isCancelled() const;

 private:
  friend class ClientCall;
  mutable std::mutex mutex_;
  grpc::ClientContext* context_ = nullptr;  ///< of the current call; null when there is none
  bool is_cancelled_ = false;
};

/// Context of one call, with the token in its metadata. One call at a time for each CallCancellation.
class ClientCall {
 public:
  /// @param cancellation must outlive this
  ClientCall(const ConnectOptions& options, CallCancellation& cancellation);
  ~ClientCall();
  ClientCall(const ClientCall&) = delete;
  ClientCall& operator=(const ClientCall&) = delete;

  grpc::ClientContext context;

 private:
  CallCancellation& cancellation_;
};

}  // namespace robosim
