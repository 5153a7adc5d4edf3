#pragma once
#include <atomic>
#include <chrono>
#include <thread>

#include "server/serving_state.h"

namespace robosim {

/// A clock that only the test advances: events that occur without advancing it did not depend on a deadline.
class ManualClock {
 public:
  using Clock = ServingState::Clock;

  Clock::time_point read() {
    while (is_blocked_) std::this_thread::yield();
    ++reads_;
    return Clock::time_point(Clock::duration(time_.load()));
  }
  void advance(Clock::duration by) { time_ += by.count(); }

  /// Blocks every reader of the clock until release(): the server stops at its next reading.
  void block() { is_blocked_ = true; }
  void release() { is_blocked_ = false; }

  /// Waits until the server has read the clock often enough to have completed a loop with the current time.
  void waitForReads() {
    constexpr long kReads = 20;
    const long until = reads_ + kReads;
    while (reads_ < until) std::this_thread::yield();
  }

 private:
  std::atomic<Clock::rep> time_{0};
  std::atomic<long> reads_{0};
  std::atomic<bool> is_blocked_{false};
};

}  // namespace robosim
