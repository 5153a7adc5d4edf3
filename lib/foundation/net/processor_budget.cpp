#include "net/processor_budget.h"

#include <algorithm>
#include <ctime>
#include <utility>

namespace robosim {

using std::chrono::nanoseconds;

void ProcessorBudget::spend(nanoseconds used, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  refill(now);
  available_ -= used;
}

std::chrono::milliseconds ProcessorBudget::wait(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  refill(now);
  if (available_ > nanoseconds(0)) return std::chrono::milliseconds(0);
  const std::chrono::duration<double, std::nano> needed = kSlice - available_;
  return std::chrono::ceil<std::chrono::milliseconds>(needed / share_);
}

void ProcessorBudget::refill(Clock::time_point now) {
  const std::chrono::duration<double, std::nano> earned = (now - std::exchange(refilled_, now)) * share_;
  if (earned >= burst_ - available_) {
    available_ = burst_;
  } else {
    available_ += std::chrono::duration_cast<nanoseconds>(earned);
  }
}

nanoseconds processorTimeOfThread() {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return std::chrono::seconds(used.tv_sec) + nanoseconds(used.tv_nsec);
}

}  // namespace robosim
