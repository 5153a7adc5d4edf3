#pragma once
#include <cstdint>
#include <functional>

#include "server/lobby.h"

namespace robosim {

/// What the people at control panels want of the run: whether it goes on, how fast, and whether it ends. Asked from
/// any thread; obeyed by the one that steps the environment. All is touched with the lobby's mutex held.
struct RunSwitch {
  bool is_paused = false;
  std::uint64_t steps_left = 0;  ///< to take although it is paused
  double speed = 0;              ///< simulated seconds a second; 0: as fast as it can
  bool stop = false;

  bool mayStep() const { return !is_paused || steps_left > 0; }
};

}  // namespace robosim
