#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/compass_deviation.h"
#include "sensors/sensor.h"

namespace robosim {

/// Heading in the world frame, (-π, π], from the world's x axis, counter-clockwise: of a magnetic compass, or of a gyro
/// that is integrated from the start of the run.
struct CompassOptions {
  std::string label = "compass";
  double noise_std_rad = 0;  ///< 0: exact
  CompassDeviation deviation;
  double gyro_drift_radps = 0;  ///< constant bias of the rate of an integrated gyro; the error grows from 0

  /// Reads <compass>. <noise/> alone is 2° (TCM2, the Pioneer's compass: 1.0°–2.5° by tilt; data sheet).
  static CompassOptions read(XmlReader&);
};

std::unique_ptr<Sensor> makeCompass(const CompassOptions&);

}  // namespace robosim
