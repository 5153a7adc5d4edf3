#pragma once
#include <algorithm>
#include <cmath>

#include "base/xml_reader.h"
#include "sensors/range_noise.h"

namespace robosim {

/// What a ping meets at the point of a body that is nearest to the sonar.
enum class SonarTarget {
  face,  ///< of a wall or box: a mirror
  edge,  ///< a corner of a box that points at the sonar, or a pillar: it diffracts or spreads the ping
};

/// Angles from the axis within which a sonar detects a target. Smooth walls act as mirrors: they are detected at their
/// nearest point, by the lobe of the transducer in that direction. A near wall is detected by the side lobes as well,
/// up to 42° from the axis (Cao & Borenstein, "Experimental characterization of Polaroid ultrasonic sensors in single
/// and phased array configuration", Proc. SPIE 4715, 2002); a far one by the main lobe only. The decrease with the
/// range is assumed to be linear. Edges and pillars return less (Kuc & Siegel, "Physically based simulation model for
/// acoustic sensor robot navigation", IEEE Trans. PAMI 9(6), 1987); their share is an assumption. Omitted: the strength
/// of the echo, which delays its detection, and materials.
struct SonarLobe {
  bool on = false;
  double wall_rad = 0;    ///< of a wall at the sonar, [0, π/2]
  double far_rad = 0;     ///< of a wall at `range_m` and beyond, [0, π/2]
  double range_m = 5;     ///< (0, 100]
  double edge_share = 1;  ///< of the angle of a wall, for edges, [0, 1]

  static SonarLobe polaroid();
  /// Reads the attributes of a <noise> element over the present values. `wall_deg` switches the lobe on.
  void read(XmlReader& noise);
  /// The largest angle from the axis at which a target at this range is detected [rad].
  double angleAt(double target_m, SonarTarget target) const;
};

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
