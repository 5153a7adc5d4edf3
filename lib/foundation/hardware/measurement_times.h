#pragma once
#include "base/sim_time.h"

namespace robosim {

/// Times at which a sensor measures. Between two measurements it keeps its reading.
struct MeasurementTimes {
  double rate_hz = 0;  ///< measurements per second of simulated time, at most one per step; 0: one in every step
  double phase_s = 0;  ///< time of a measurement, modulo the period

  /// Whether the sensor measures in a step: in step 0, then in each first step that ends no earlier than the next due
  /// time. At a rate above the step rate it measures in every step.
  bool isDue(const SimTime& now) const;
  bool operator==(const MeasurementTimes&) const = default;
};

}  // namespace robosim
