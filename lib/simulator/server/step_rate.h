#pragma once
#include <chrono>
#include <cstdint>

namespace robosim {

/// Measures the step rate over windows of at least one second.
class StepRate {
 public:
  using Clock = std::chrono::steady_clock;

  void note(Clock::time_point now) {
    ++steps_;
    const std::chrono::duration<double> passed = now - since_;
    if (passed.count() < 1) return;
    rate_ = static_cast<double>(steps_) / passed.count();
    steps_ = 0;
    since_ = now;
  }
  /// Restarts the window, so that paused time does not count.
  void rest(Clock::time_point now) {
    steps_ = 0;
    since_ = now;
  }
  double stepsPerSecond() const { return rate_; }

 private:
  Clock::time_point since_ = Clock::now();
  std::uint64_t steps_ = 0;
  double rate_ = 0;
};

}  // namespace robosim
