#include "net/client_call.h"

namespace robosim {

void CallCancellation::cancel() {
  const std::lock_guard lock(mutex_);
  is_cancelled_ = true;
  if (context_) context_->TryCancel();
}

bool CallCancellation::isCancelled() const {
  const std::lock_guard lock(mutex_);
  return is_cancelled_;
}

ClientCall::ClientCall(const ConnectOptions& options, CallCancellation& cancellation) : cancellation_(cancellation) {
  attachToken(context, options);
  const std::lock_guard lock(cancellation_.mutex_);
  cancellation_.context_ = &context;
  if (cancellation_.is_cancelled_) context.TryCancel();
}

ClientCall::~ClientCall() {
  const std::lock_guard lock(cancellation_.mutex_);
  cancellation_.context_ = nullptr;
}

}  // namespace robosim
