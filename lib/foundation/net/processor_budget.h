#pragma once
#include <chrono>
#include <mutex>

namespace robosim {

/// Processor time that several threads may use together: a token bucket. Thread-safe.
class ProcessorBudget {
 public:
  using Clock = std::chrono::steady_clock;
  /// Minimum time between two waits of a thread that uses all of it, so that its wake-ups cost little.
  static constexpr std::chrono::milliseconds kSlice{2};

  /// @param share of one processor, above 0 @param burst processor time available after a rest
  ProcessorBudget(double share, std::chrono::nanoseconds burst) : share_(share), burst_(burst), available_(burst) {}

  void spend(std::chrono::nanoseconds used, Clock::time_point now);
  /// Time until kSlice is available, if nothing is; else 0.
  std::chrono::milliseconds wait(Clock::time_point now);

 private:
  void refill(Clock::time_point now);

  const double share_;
  const std::chrono::nanoseconds burst_;
  std::mutex mutex_;
  std::chrono::nanoseconds available_;  ///< may be negative
  Clock::time_point refilled_{};        ///< the bucket is full at first
};

/// Processor time that the calling thread has used.
std::chrono::nanoseconds processorTimeOfThread();

}  // namespace robosim
