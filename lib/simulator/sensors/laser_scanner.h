#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/laser_errors.h"
#include "sensors/sensor.h"

namespace robosim {

/// Times at which a scanner measures.
struct LaserTiming {
  double sweep_s = 0;  ///< from the first to the last beam, which is measured at the time step, [0, 10]
  /// By which the beams of odd index are later than those of even index, which another revolution measures, [0, 10].
  double interlace_s = 0;
  double latency_s = 0;  ///< mean age of the last beam at the time step, [0, 10]
  /// Standard deviation of that age from scan to scan, [0, 10]: normal, and at least 0. All beams of a scan share it.
  double latency_std_s = 0;
  double latency_tail = 0;         ///< probability that latency_std_s is multiplied by latency_tail_factor, [0, 1]
  double latency_tail_factor = 3;  ///< [1, 100]
  MeasurementTimes times = {};     ///< of the scans: rate_hz in [0, 1000], phase_s in [0, 1e6]

  bool operator==(const LaserTiming&) const = default;

  /// Reads all but interlace_s from a sensor's element; sweep_s is the default of its attribute.
  void read(XmlReader& reader);
  /// Age of the last beam of a robot's scan [s]. Its random numbers are those of one beam more than the scanner has.
  double drawLatency(const Snapshot& now, std::uint32_t robot, std::size_t slot, std::size_t beams) const;
};

/// Makes a scanner of thin beams with errors and times of measurement.
///
/// While the robot moves, each beam starts from the pose at its own time: on the arc of the robot's last motion, which
/// is extrapolated beyond one time step. Other bodies remain at their poses of the time step. A panning scanner has the
/// pan angle of the time step. With a rate, the sensor runs in the process that hosts the run, because its reading
/// depends on the last one.
/// @param info specifies beams, ranges and label
std::unique_ptr<Sensor> makeLaserScanner(const SensorInfo& info, const LaserErrors& errors, const LaserTiming& timing);

}  // namespace robosim
