#include "recording/kept_readings.h"

#include <utility>

namespace robosim {

KeptReadings::KeptReadings(std::shared_ptr<const std::vector<SensorInfo>> sensors, bool by_equality)
    : sensors_(std::move(sensors)), by_equality_(by_equality) {
  forget();
}

bool KeptReadings::isKept(std::size_t sensor, const Readings& readings) {
  const MeasurementTimes& times = (*sensors_)[sensor].times;
  if (times.rate_hz == 0 && !by_equality_) return false;
  const Measurement& measurement = readings.measurements[sensor];
  if ((by_equality_ || !times.isDue(readings.time)) && measurement == last_[sensor]) return true;
  last_[sensor] = measurement;
  return false;
}

void KeptReadings::forget() {
  last_.clear();
  for (const auto& sensor : *sensors_) last_.push_back(blankMeasurement(sensor));
}

}  // namespace robosim
