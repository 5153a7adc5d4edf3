#pragma once
#include "base/xml_reader.h"

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

}  // namespace robosim
