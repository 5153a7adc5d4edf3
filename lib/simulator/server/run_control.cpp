#include "server/run_control.h"

namespace robosim {

std::string speedFault(double speed, bool is_realtime) {
  if (speed == 0 && is_realtime) {
    return "with the pace realtime the speed cannot be unlimited; specify a speed, 1 for real time";
  }
  if (speed == 0 || (speed >= 0.001 && speed <= 1e6)) return "";
  return "a speed of " + std::to_string(speed) + "; must lie in [0.001, 1000000], or be 0 for unlimited speed";
}

std::string stepsFault(std::uint64_t steps) {
  if (steps >= 1 && steps <= kStepsMax) return "";
  return std::to_string(steps) + " steps; must lie in [1, " + std::to_string(kStepsMax) + "]";
}

}  // namespace robosim
