#include "recording/kept_readings.h"

#include <utility>

namespace robosim {

KeptReadings::KeptReadings(std::shared_ptr<const std::vector<SensorInfo>> sensors) : sensors_(std::move(sensors)) {
  forget();
}

bool KeptReadings::isKept(std::size_t sensor, const Readings& readings) {
  const MeasurementTimes& times = (*sensors_)[sensor].times;
  if (times.rate_hz == 0) return false;
  const Measurement& measurement = readings.measurements[sensor];
  if (!times.isDue(readings.time) && measurement == last_[sensor]) return true;
  last_[sensor] = measurement;
  return false;
}

void KeptReadings::forget() {
  last_.clear();
  for (const auto& sensor : *sensors_) last_.push_back(blankMeasurement(sensor));
}

}  // namespace robosim
