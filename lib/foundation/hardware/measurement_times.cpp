#include "hardware/measurement_times.h"

#include <cmath>

namespace robosim {

bool MeasurementTimes::isDue(const SimTime& now) const {
  if (rate_hz == 0 || now.step == 0) return true;
  constexpr double kTolerance = 1e-6;  // in measurements; absorbs the rounding error of the time
  const auto due = [&](std::uint64_t step) {
    return std::floor((static_cast<double>(step) * now.period_s - phase_s) * rate_hz + kTolerance);
  };
  return due(now.step) > due(now.step - 1);
}

}  // namespace robosim
