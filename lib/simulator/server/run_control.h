#pragma once
#include <cstdint>

namespace robosim {

/// State of the run as set by control panels: paused or running, speed, and stop. Used only by the thread that steps
/// the environment.
struct RunControl {
  bool is_paused = false;
  std::uint64_t steps_left = 0;  ///< steps to take while paused
  double speed = 0;              ///< simulated seconds per second; 0: unlimited
  bool stop = false;

  bool mayStep() const { return !is_paused || steps_left > 0; }
};

}  // namespace robosim
