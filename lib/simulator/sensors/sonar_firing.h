#pragma once
#include <cmath>
#include <cstdint>

#include "base/sim_time.h"
#include "base/xml_reader.h"

namespace robosim {

/// Order in which the sonars of a robot fire: one sonar of each array at a time, in turn. A Pioneer has arrays of eight
/// sonars that fire every 40 ms (ActivMedia Robotics, *Pioneer 2 / PeopleBot Operations Manual*: 25 Hz), so that a
/// reading is up to 320 ms old.
struct SonarFiring {
  double interval_s = 0;  ///< between two sonars of an array, [0, 10]; 0: all fire in every step
  int array = 8;          ///< number of sonars per array, [1, 1024], in the order of the readings

  static SonarFiring read(XmlReader& sonar) {
    SonarFiring firing;
    firing.interval_s = sonar.number("firing_interval_s", Bounds::notNegative(10), firing.interval_s);
    const double array = sonar.number("array", {1, 1024}, firing.array);
    if (array != std::floor(array)) sonar.errorAt("array", "must be a whole number");
    firing.array = static_cast<int>(array);
    return firing;
  }
  bool isSimultaneous() const { return interval_s == 0; }
  /// Whether a sonar fires in a step. All fire in step 0.
  bool fires(std::size_t sonar, const SimTime& now) const {
    if (isSimultaneous() || now.step == 0) return true;
    const std::int64_t before = pings(now.step - 1, now.period_s), after = pings(now.step, now.period_s);
    const auto turn = static_cast<std::int64_t>(sonar % static_cast<std::size_t>(array));
    // The latest ping of this sonar up to now, counted from 0.
    const std::int64_t last = after - 1 - turn;
    return last >= 0 && last / array * array + turn >= before;
  }

 private:
  /// Number of pings of an array up to the end of a step.
  std::int64_t pings(std::uint64_t step, double period_s) const {
    constexpr double kTolerance = 1e-6;  // absorbs the rounding error of the time
    return static_cast<std::int64_t>(std::floor(static_cast<double>(step) * period_s / interval_s + kTolerance));
  }
};

}  // namespace robosim
