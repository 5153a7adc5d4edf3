#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>

#include <gtest/gtest.h>

#include "server/serving_state.h"
#include "tests/scenarios/program.h"

namespace robosim {

/// A clock that only the test advances: events that occur without advancing it did not depend on a deadline.
class ManualClock {
 public:
  using Clock = ServingState::Clock;

  Clock::time_point read() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !is_blocked_; });
    ++reads_;
    changed_.notify_all();
    return time_;
  }
  void advance(Clock::duration by) {
    const std::lock_guard lock(mutex_);
    time_ += by;
  }

  /// Blocks every reader of the clock until release(): the server stops at its next reading.
  void block() { setBlocked(true); }
  void release() { setBlocked(false); }

  /// Waits until the server has read the clock often enough to have completed a loop with the current time.
  void waitForReads() {
    constexpr long kReads = 20;
    std::unique_lock lock(mutex_);
    const long until = reads_ + kReads;
    EXPECT_TRUE(changed_.wait_for(lock, kLongestWait, [&] { return reads_ >= until; })) << "the server reads no clock";
  }

 private:
  void setBlocked(bool is_blocked) {
    const std::lock_guard lock(mutex_);
    is_blocked_ = is_blocked;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  Clock::time_point time_;
  long reads_ = 0;
  bool is_blocked_ = false;
};

}  // namespace robosim
