#include "recording/observation_times.h"

#include <mrpt/system/datetime.h>

namespace robosim {

double secondsBetween(mrpt::Clock::time_point from, mrpt::Clock::time_point to) {
  using Ticks = mrpt::Clock::duration;
  constexpr double kTicksPerSecond = static_cast<double>(Ticks::period::den) / Ticks::period::num;
  const Ticks::rep a = from.time_since_epoch().count(), b = to.time_since_epoch().count();
  Ticks::rep difference = 0;
  // A damaged file may contain any numbers.
  if (__builtin_sub_overflow(b, a, &difference))
    return (static_cast<double>(b) - static_cast<double>(a)) / kTicksPerSecond;
  return static_cast<double>(difference) / kTicksPerSecond;
}

double ObservationTimes::of(const mrpt::obs::CObservation& observation, std::uint64_t entry) {
  if (!first_entry_) first_entry_ = entry;
  if (observation.timestamp == INVALID_TIMESTAMP) {
    if (!first_stamp_) last_s_ = static_cast<double>(entry - *first_entry_) * kUntimedStep_s;
    return last_s_;
  }
  if (!first_stamp_) {
    first_stamp_ = observation.timestamp;
    first_stamp_s_ = static_cast<double>(entry - *first_entry_) * kUntimedStep_s;
  }
  return last_s_ = first_stamp_s_ + secondsBetween(*first_stamp_, observation.timestamp);
}

}  // namespace robosim
