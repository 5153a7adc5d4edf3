#pragma once
#include <cstdint>

namespace robosim {

/// Simulation time: a number of steps of equal length. The time is computed from this number, not accumulated, so that
/// it does not drift.
struct SimTime {
  std::uint64_t step = 0;
  double period_s = 0.1;  ///< (0, 1]

  bool operator==(const SimTime&) const = default;
  double seconds() const { return static_cast<double>(step) * period_s; }
};

}  // namespace robosim
