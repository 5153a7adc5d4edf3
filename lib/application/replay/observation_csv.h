#pragma once
#include <map>
#include <string>

#include <mrpt/obs/CObservation.h>

#include "hardware/sensor_info.h"

namespace robosim {

/// Writer of observations as comma-separated values (RFC 4180 with LF line ends). A row is "seconds,label," followed by
/// the values in full. A row whose columns differ from those of its label's row before, as every first one, is preceded
/// by a row of column names that begins with "seconds,label". Column names end in units.
class ObservationCsv {
 public:
  /// The observation's row, preceded by the column names if it is the first of its label.
  /// @param sensor its description (RecordedSensors); null if unknown
  std::string lines(const mrpt::obs::CObservation& observation, double time_s, const SensorInfo* sensor = nullptr);

 private:
  std::map<std::string, std::string> names_;  ///< last column names, by label
};

}  // namespace robosim
