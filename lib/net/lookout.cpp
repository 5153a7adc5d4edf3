#include "net/lookout.h"

#include <thread>

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

bool next(grpc::CompletionQueue& queue, gpr_timespec until, void*& tag, bool& ok) {
  return queue.AsyncNext(&tag, &ok, until) == grpc::CompletionQueue::GOT_EVENT;
}

bool lookOut(grpc::CompletionQueue& queue, Lookout& lookout, gpr_timespec until, void*& tag, bool& ok) {
  const auto start = Clock::now();
  while (Clock::now() - start < Lookout::kPatience) {
    if (next(queue, gpr_time_0(GPR_CLOCK_MONOTONIC), tag, ok)) {
      lookout.succeeded();
      return true;
    }
    if (gpr_time_cmp(gpr_now(until.clock_type), until) >= 0) return false;
    std::this_thread::yield();  // the peer may be the one that wants this processor
  }
  lookout.failed();
  return false;
}

}  // namespace

bool awaitEvent(grpc::CompletionQueue& queue, Lookout& lookout, gpr_timespec until, void*& tag, bool& ok) {
  if (lookout.isWorthwhile() && lookOut(queue, lookout, until, tag, ok)) return true;
  const auto start = Clock::now();
  const bool has_come = next(queue, until, tag, ok);
  lookout.slept(has_come ? Clock::now() - start : Lookout::Duration::max());
  return has_come;
}

}  // namespace robosim
