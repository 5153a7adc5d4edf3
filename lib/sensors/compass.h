#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/compass_deviation.h"
#include "sensors/sensor.h"

namespace robosim {

/// Heading in the world frame, (-π, π], from the world's x axis, counter-clockwise.
struct CompassOptions {
  std::string label = "compass";
  double noise_std_rad = 0;  ///< 0: exact
  CompassDeviation deviation;

  /// Reads <compass>. <noise/> alone is 2° (TCM2, the Pioneer's compass: 1.0°–2.5° by tilt; data sheet).
  static CompassOptions read(XmlReader&);
};

std::unique_ptr<Sensor> makeCompass(const CompassOptions&);

}  // namespace robosim
