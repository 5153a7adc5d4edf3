#pragma once
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/angle_units.h"
#include "base/sim_time.h"
#include "base/xml_reader.h"
#include "sensors/registry.h"
#include "sensors/sensor.h"
#include "sensors/sonar_noise.h"

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

/// Model of one sonar's beam.
enum class SonarModel {
  sector,  ///< the exact nearest point of any object inside the planar wedge
  rays,    ///< the nearest hit of a bundle of rays that fills the cone, in 3D
};

/// A ring of sonars.
struct SonarOptions {
  std::string label = "sonar";
  SonarModel model = SonarModel::sector;
  std::vector<Beam> beams;                  ///< in the order of the readings
  double range_min_m = 0;                   ///< [0, range_max_m): nearer objects read this
  double range_max_m = 5;                   ///< (0, 100]: only nearer objects return an echo
  double no_echo_m = 5;                     ///< [range_max_m, 1000]: reading without an echo
  double beam_width_rad = 20 * kRadPerDeg;  ///< full angle of the cone, (0°, 120°]; 2005: 20°
  int rays = 19;                            ///< for the model `rays`, [1, 1000]; 1: the axis only
  SonarFiring firing;
  SonarNoise noise;

  std::size_t rayCount() const;

  /// Reads <sonar>. @throws nothing: faults go to the reader's list.
  static SonarOptions read(XmlReader&);
  /// Reads a 2005 <sensor> of type sonar. Its 8 (mode 1, front) or 16 (mode 2) sonars are mounted as in Table 1 of the
  /// 2005 report: on a ring of the robot's radius about its centre, numbered from its right over its front to its left
  /// and around its back, at the height of <z-relative> above the robot's centre. No echo reads the range + 1 unit.
  static SonarOptions read2005(XmlReader&, const Mount&);
};

std::unique_ptr<Sensor> makeSonar(const SonarOptions&);

}  // namespace robosim
