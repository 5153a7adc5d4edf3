#include "net/adaptive_polling.h"

#include <thread>

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

bool next(grpc::CompletionQueue& queue, gpr_timespec until, void*& tag, bool& ok) {
  return queue.AsyncNext(&tag, &ok, until) == grpc::CompletionQueue::GOT_EVENT;
}

bool poll(grpc::CompletionQueue& queue, AdaptivePolling& polling, gpr_timespec until, void*& tag, bool& ok) {
  const auto start = Clock::now();
  while (Clock::now() - start < AdaptivePolling::kMaxPollTime) {
    if (next(queue, gpr_time_0(GPR_CLOCK_MONOTONIC), tag, ok)) {
      polling.recordPollSuccess();
      return true;
    }
    if (gpr_time_cmp(gpr_now(until.clock_type), until) >= 0) return false;
    std::this_thread::yield();  // the peer may need this processor
  }
  polling.recordPollTimeout();
  return false;
}

}  // namespace

bool awaitEvent(grpc::CompletionQueue& queue, AdaptivePolling& polling, gpr_timespec until, void*& tag, bool& ok) {
  if (polling.shouldPoll() && poll(queue, polling, until, tag, ok)) return true;
  const auto start = Clock::now();
  const bool has_event = next(queue, until, tag, ok);
  polling.recordSleep(has_event ? Clock::now() - start : AdaptivePolling::Duration::max());
  return has_event;
}

}  // namespace robosim
