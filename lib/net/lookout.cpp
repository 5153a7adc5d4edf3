#include "net/lookout.h"

#include <thread>

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

bool next(grpc::CompletionQueue& queue, gpr_timespec until, void*& tag, bool& ok) {
  return queue.AsyncNext(&tag, &ok, until) == grpc::CompletionQueue::GOT_EVENT;
}

bool lookOut(grpc::CompletionQueue& queue, Lookout& lookout, void*& tag, bool& ok) {
  const auto start = Clock::now();
  for (auto looked = start; looked - start < Lookout::kPatience;) {
    if (next(queue, gpr_time_0(GPR_CLOCK_MONOTONIC), tag, ok)) {
      lookout.succeeded();
      return true;
    }
    std::this_thread::yield();  // the peer may be the one that wants this processor
    const auto now = Clock::now();
    if (now - looked > Lookout::kInterruption) break;
    looked = now;
  }
  lookout.failed();
  return false;
}

}  // namespace

bool awaitEvent(grpc::CompletionQueue& queue, Lookout& lookout, gpr_timespec until, void*& tag, bool& ok) {
  if (lookout.isWorthwhile() && lookOut(queue, lookout, tag, ok)) return true;
  const auto start = Clock::now();
  const bool has_come = next(queue, until, tag, ok);
  lookout.slept(has_come ? Clock::now() - start : Lookout::Duration::max());
  return has_come;
}

}  // namespace robosim
