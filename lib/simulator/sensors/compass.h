#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/sensor.h"

namespace robosim {

/// Deviation of a magnetic compass on a robot: a constant error of its mounting, a sinusoid once per turn by magnetised
/// iron (hard iron), and one twice per turn by iron that the earth's field magnetises (soft iron). These are the
/// coefficients A, B and C, D and E of the deviation of ships' compasses (Archibald Smith's formula; Bowditch, *The
/// American Practical Navigator*, on compass adjustment), each pair as amplitude and direction. Omitted: tilt, and
/// fields of motors that change with their current.
struct CompassDeviation {
  double offset_rad = 0;        ///< A, [-π, π]
  double hard_iron_rad = 0;     ///< amplitude, [0, π/2]
  double hard_iron_at_rad = 0;  ///< heading at which that error rises through 0
  double soft_iron_rad = 0;     ///< amplitude, [0, π/2]
  double soft_iron_at_rad = 0;  ///< a heading at which that error rises through 0

  /// Reads the attributes of a <noise> element.
  static CompassDeviation read(XmlReader& noise);
  bool isNone() const { return offset_rad == 0 && hard_iron_rad == 0 && soft_iron_rad == 0; }
  /// The error at a true heading [rad].
  double at(double heading_rad) const;
};

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
