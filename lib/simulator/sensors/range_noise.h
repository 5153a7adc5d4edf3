#pragma once
#include "base/random.h"
#include "base/xml_reader.h"

namespace robosim {

/// Error model of a range sensor: the Gaussian and the "max" part of the beam model of Thrun, Burgard & Fox,
/// *Probabilistic Robotics* (2005), §6.3. Its short readings are omitted because their causes, other robots, are in the
/// scene. Off by default; a <noise/> element switches it on, with the data sheet's values for attributes that it omits.
struct RangeNoise {
  bool on = false;
  double std_m = 0;      ///< standard deviation, [0, 1]
  double std_per_m = 0;  ///< its growth with the range, [0, 1]
  double dropout = 0;    ///< probability that an echo is lost, [0, 1]

  /// Reads a <noise> element; `data_sheet` holds the defaults of its attributes. The caller finishes the element.
  static RangeNoise read(XmlReader& noise, const RangeNoise& data_sheet);
  /// The standard deviation at a range [m]; 0 when the noise is off.
  double stdAt(double range_m) const { return on ? std_m + std_per_m * range_m : 0; }
  /// The measured range: at least 0; infinite when the echo is lost or the input was infinite.
  double apply(double range_m, Rng& rng) const;
};

}  // namespace robosim
