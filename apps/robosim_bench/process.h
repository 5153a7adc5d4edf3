#pragma once
#include <functional>

#include <nlohmann/json_fwd.hpp>

namespace robosim {

/// Memory use of this process, in units of 2^20 bytes.
struct Memory {
  double resident_mb = 0;  ///< now
  double peak_mb = 0;      ///< maximum so far
  static Memory now();
};

/// Processor use by other programs since construction.
class OtherLoad {
 public:
  OtherLoad();
  double processors() const;  ///< average number in use by other programs
  static long ofProcessors();

 private:
  static double othersTime();
  double start_s_;
  double others_s_;
};

/// Error text of an interrupted benchmark.
constexpr const char* kInterrupted = "interrupted before all was measured";

/// Measures in a child process, so that previous measurements and their memory have no effect. Must be called while
/// there is only one thread.
/// @param measure returns the figures
/// @throws std::runtime_error with the text of what `measure` threw, or when the child process crashed
nlohmann::json runInChildProcess(const std::function<nlohmann::json()>& measure);

}  // namespace robosim
