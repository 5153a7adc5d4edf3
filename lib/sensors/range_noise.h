#pragma once
#include "base/random.h"
#include "base/xml_reader.h"

namespace robosim {

/// How a range sensor errs: the Gaussian and the "max" part of the beam model of Thrun, Burgard & Fox, *Probabilistic
/// Robotics* (2005), §6.3. Its short readings are left out: what causes them, other robots, is in the scene. Off by
/// default; a <noise/> element switches it on, with the data sheet's figures where it names none of its own.
struct RangeNoise {
  bool on = false;
  double std_m = 0;      ///< standard deviation, [0, 1]
  double std_per_m = 0;  ///< its growth with the range, [0, 1]
  double dropout = 0;    ///< probability that an echo is not heard, [0, 1]

  /// Reads a <noise> element; `data_sheet` holds the values of a <noise/> without attributes. The caller finishes it.
  static RangeNoise read(XmlReader& noise, const RangeNoise& data_sheet);
  /// The range as measured: at least 0; infinite for one that is dropped, or was infinite.
  double apply(double range_m, Rng& rng) const;
};

}  // namespace robosim
