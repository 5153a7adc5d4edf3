#pragma once
#include <string>
#include <vector>

#include <mrpt/obs/CObservation.h>

#include "hardware/sensor_info.h"
#include "replay/recorded_series.h"

namespace robosim {

/// The values of an observation with the names of their columns, which end in units: "range_3_m".
struct ObservationRow {
  std::vector<std::string> names;   ///< as many as values
  std::vector<ColumnValue> values;  ///< in full precision; texts are printable

  /// @param sensor its description (RecordedSensors); null if unknown
  static ObservationRow of(const mrpt::obs::CObservation& observation, const SensorInfo* sensor = nullptr);
};

}  // namespace robosim
