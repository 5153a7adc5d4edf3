#pragma once
#include <cstdint>

namespace robosim {

/// What the people at control panels want of the run: whether it goes on, how fast, and whether it ends. Belongs to the
/// thread that steps the environment.
struct RunSwitch {
  bool is_paused = false;
  std::uint64_t steps_left = 0;  ///< to take although it is paused
  double speed = 0;              ///< simulated seconds a second; 0: as fast as it can
  bool stop = false;

  bool mayStep() const { return !is_paused || steps_left > 0; }
};

}  // namespace robosim
