#pragma once
#include <atomic>
#include <chrono>
#include <thread>

#include "server/lobby.h"

namespace robosim {

/// A clock that stands until a test moves it: what goes on meanwhile has waited for no deadline.
class HandClock {
 public:
  using Clock = Lobby::Clock;

  Clock::time_point read() {
    while (is_held_) std::this_thread::yield();
    ++reads_;
    return Clock::time_point(Clock::duration(time_.load()));
  }
  void advance(Clock::duration by) { time_ += by.count(); }

  /// Whoever looks at the clock waits until release(): so the server stands still wherever it looks next.
  void hold() { is_held_ = true; }
  void release() { is_held_ = false; }

  /// Waits until the server has looked at the clock so often that it must have gone round once with the time of now.
  void waitUntilSeen() {
    constexpr long enough = 20;
    const long until = reads_ + enough;
    while (reads_ < until) std::this_thread::yield();
  }

 private:
  std::atomic<Clock::rep> time_{0};
  std::atomic<long> reads_{0};
  std::atomic<bool> is_held_{false};
};

}  // namespace robosim
