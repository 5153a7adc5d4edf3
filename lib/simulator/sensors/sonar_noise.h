#pragma once
#include <algorithm>
#include <cmath>

#include "base/xml_reader.h"
#include "sensors/range_noise.h"
#include "sensors/sonar_lobe.h"

namespace robosim {

/// Errors of a sonar. The set `polaroid` describes the Polaroid 6500 module with the 600 series transducer;
/// doc/fidelity.md lists the source of each value.
struct SonarNoise {
  RangeNoise range;
  double specular_rad = M_PI;      ///< a surface at a larger angle of incidence returns no echo; [0, π], π: never
  SonarLobe lobe;                  ///< in place of specular_rad, if it is on
  bool has_second_echoes = false;  ///< a specular surface may return an echo by way of another surface
  double blanking_m = 0;           ///< [0, range_max_m]: echoes from nearer are lost, but for their repetitions
  double ringing = 0;              ///< probability of a false echo at the end of the blanking, [0, 1]
  double crosstalk = 0;            ///< probability of reading the nearer echo of an adjacent sonar that fires, [0, 1]
  double robot_crosstalk = 0;      ///< probability of receiving another robot's ping, if one is in view, [0, 1]

  /// Reads the attribute `noise` of <sonar> and its child <noise>.
  static SonarNoise read(XmlReader& sonar, double range_max_m);
  /// Whether the echoes differ from the geometry's, before random errors.
  bool hasReflections() const { return lobe.on || specular_rad < M_PI; }
};

}  // namespace robosim
