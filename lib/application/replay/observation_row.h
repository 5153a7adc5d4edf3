#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <mrpt/obs/CObservation.h>

#include "hardware/sensor_info.h"

namespace robosim {

/// Value of a column; none: nothing was measured, such as an absent echo.
using ColumnValue = std::variant<std::monostate, float, double, std::int64_t, std::string>;

/// The values of an observation with the names of their columns, which end in units: "range_3_m".
struct ObservationRow {
  std::vector<std::string> names;   ///< as many as values
  std::vector<ColumnValue> values;  ///< in full precision; texts are printable

  /// @param sensor its description (RecordedSensors); null if unknown
  static ObservationRow of(const mrpt::obs::CObservation& observation, const SensorInfo* sensor = nullptr);
};

}  // namespace robosim
