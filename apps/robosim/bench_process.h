#pragma once
#include <functional>

#include <nlohmann/json.hpp>

namespace robosim {

/// What this process holds in memory, in units of 2^20 bytes.
struct Memory {
  double resident_mb = 0;  ///< now
  double peak_mb = 0;      ///< the most so far
  static Memory now();
};

/// Measures in a process of its own, so that neither what was measured before nor its leftover memory matters. Call it
/// while there is only one thread.
/// @param measure makes the figures
/// @throws std::runtime_error with what `measure` threw, or when its process died
nlohmann::json inOwnProcess(const std::function<nlohmann::json()>& measure);

}  // namespace robosim
