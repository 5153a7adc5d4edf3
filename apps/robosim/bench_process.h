#pragma once
#include <functional>

#include <nlohmann/json_fwd.hpp>

namespace robosim {

/// What this process holds in memory, in units of 2^20 bytes.
struct Memory {
  double resident_mb = 0;  ///< now
  double peak_mb = 0;      ///< the most so far
  static Memory now();
};

/// How much other programs have used the machine's processors since this was made.
class Company {
 public:
  Company();
  double processors() const;  ///< kept busy by others, on average
  static long ofProcessors();

 private:
  static double othersTime();
  double start_s_;
  double others_s_;
};

/// What a bench says that was interrupted.
constexpr const char* kInterrupted = "interrupted before all was measured";

/// Measures in a process of its own, so that neither what was measured before nor its leftover memory matters. Call it
/// while there is only one thread.
/// @param measure makes the figures
/// @throws std::runtime_error with what `measure` threw, or when its process died
nlohmann::json inOwnProcess(const std::function<nlohmann::json()>& measure);

}  // namespace robosim
