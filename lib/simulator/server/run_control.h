#pragma once
#include <cstdint>
#include <string>

namespace robosim {

/// Upper limit of the steps of a request; rejects typing errors.
inline constexpr std::uint64_t kStepsMax = 1'000'000'000;

/// State of the run as set by control panels and others: paused or running, speed, and stop. Used only by the thread
/// that steps the environment.
struct RunControl {
  bool is_paused = false;
  std::uint64_t steps_left = 0;  ///< steps to take while paused
  double speed = 0;              ///< simulated seconds per second; 0: unlimited
  bool stop = false;

  bool mayStep() const { return !is_paused || steps_left > 0; }

  /// Takes steps, and pauses. @param steps at most kStepsMax
  void step(std::uint64_t steps) {
    is_paused = true;
    steps_left += steps;
  }
  void pause(bool on) {
    is_paused = on;
    steps_left = 0;
  }
};

/// Why a speed cannot be set; empty if it can. @param is_realtime whether the run keeps real time
std::string speedFault(double speed, bool is_realtime);
/// The same for steps.
std::string stepsFault(std::uint64_t steps);

}  // namespace robosim
