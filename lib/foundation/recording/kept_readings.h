#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "hardware/readings.h"
#include "hardware/robot_info.h"

namespace robosim {

/// Which sensors of a robot keep their reading in a step, because they do not measure (SensorInfo::times). A reading
/// that differs from the one before, which is that of blankMeasurement() at first, is not kept.
class KeptReadings {
 public:
  /// @param by_equality whether a reading is kept if it is that of the step before: of a recording of another program,
  ///        in which no rates are known
  explicit KeptReadings(std::shared_ptr<const std::vector<SensorInfo>> sensors, bool by_equality = false);

  /// Of the next step.
  bool isKept(std::size_t sensor, const Readings& readings);
  /// Forgets the readings of the step before, of a robot that is absent.
  void forget();

 private:
  std::shared_ptr<const std::vector<SensorInfo>> sensors_;
  bool by_equality_;
  std::vector<Measurement> last_;  ///< by sensor: the last one that was not kept, if it has a rate
};

}  // namespace robosim
