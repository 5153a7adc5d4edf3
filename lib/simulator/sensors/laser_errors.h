#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "base/xml_reader.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Error model of a laser scanner. All parts are off by default. Each beam has four random numbers of its own in each
/// measurement, whatever it hits, so that the beams are independent. Sources, units, ranges and omissions:
/// doc/fidelity.md.
struct LaserErrors {
  /// A point of a piecewise-linear function of the range.
  struct StdAt {
    double range_m = 0;  ///< [0, 1000]
    double std_m = 0;    ///< [0, 1]
    bool operator==(const StdAt&) const = default;
  };

  double std_m = 0;      ///< standard deviation at range 0, [0, 1]
  double std_per_m = 0;  ///< its growth with the range, [0, 1]
  /// Standard deviation by ascending range, constant beyond both ends; replaces std_m and std_per_m unless empty.
  std::vector<StdAt> std_at;
  double tail = 0;            ///< probability that the error of a reading is multiplied by tail_factor, [0, 1]
  double tail_factor = 3;     ///< [1, 100]
  double quantum_m = 0;       ///< readings are multiples of this, [0, 1]; 0: any
  double dropout = 0;         ///< probability that an echo is lost, [0, 1]
  double outlier = 0;         ///< probability that the reading of an echo is uniform within the ranges, [0, 1]
  double divergence_rad = 0;  ///< full angle of a beam, [0, 0.2]; 0: no mixed pixels
  double mixing_m = 2;        ///< surfaces that are farther apart are not mixed: the stronger is read, [0, 1000]
  double mixing_std = 0.1;    ///< standard deviation of a surface's share of a mixed pixel, [0, 1]
  double reach_m = 0;   ///< at which half of the echoes of a white surface, perpendicular to the beam, are lost; 0: ∞
  double fading = 0.2;  ///< scale of the logistic fluctuation of the logarithm of an echo's power, (0, 10]
  double drift_m = 0;   ///< offset of all ranges at the start of the run, [-1, 1]
  double drift_s = 600;  ///< time in which it decreases to 1/e, (0, 1e6]

  /// Reads a <noise> element whose attributes replace the values of `otherwise`. The caller finishes the element.
  static LaserErrors read(XmlReader& noise, const LaserErrors& otherwise);

  /// Whether the results depend on random numbers.
  bool isRandom() const;
  /// Standard deviation [m] of the Gaussian part at a range.
  double stdAt(double range_m) const;
  /// Standard deviation [m] of a reading about its mean at a range: Gaussian part with its tail, and quantisation.
  double readingStdAt(double range_m) const;
  /// The largest readingStdAt() of all ranges up to `range_max_m`.
  double largestStd(double range_max_m) const;
  /// Offset [m] of all ranges at a time since the start of the run [s].
  double driftAt(double time_s) const;

  bool operator==(const LaserErrors&) const = default;
};

/// Random numbers of one beam in one measurement.
struct BeamDraw {
  double event = 0;     ///< uniform in [0, 1)
  double other = 0;     ///< uniform in (0, 1)
  double gaussian = 0;  ///< mean 0, standard deviation 1
};

/// Applies a LaserErrors to many ranges of one measurement.
class ErrorProcess {
 public:
  /// @param info specifies the ranges
  ErrorProcess(const LaserErrors& errors, const SensorInfo& info);

  /// The range [m] that is read for a true range within (0, range_max_m), or infinity for a lost echo.
  /// @param power of the echo, relative to that which is detected half of the time
  /// @param drift_m of LaserErrors::driftAt()
  double readingOf(double range_m, double power, double drift_m, const BeamDraw& draw) const;

 private:
  bool isDetected(double power, double uniform) const;

  LaserErrors errors_;
  double range_min_m_, range_max_m_;
  double tail_from_, tail_to_;  ///< the events of a wide error
  double per_quantum_;
  double lost_power_, certain_power_;  ///< below and above which the detection is not random
  /// By n: the power above which an echo is detected for all numbers of at least 2^-n.
  std::array<double, 34> sufficient_power_;
};

}  // namespace robosim
