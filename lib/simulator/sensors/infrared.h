#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/infrared_curve.h"
#include "sensors/range_noise.h"
#include "sensors/sensor.h"

namespace robosim {

/// Short-range single beams around the robot. Defaults: Sharp GP2D12, 10 cm … 80 cm (data sheet).
struct InfraredOptions {
  std::string label = "infrared";
  std::vector<Beam> beams;   ///< in the order of the readings
  double range_min_m = 0.1;  ///< [0, range_max_m): nearer objects read this
  double range_max_m = 0.8;  ///< (0, 10]: only nearer objects are detected; no echo reads this
  RangeNoise noise;
  InfraredCurve curve;

  /// Reads <infrared>.
  static InfraredOptions read(XmlReader&);
};

std::unique_ptr<Sensor> makeInfrared(const InfraredOptions&);

}  // namespace robosim
