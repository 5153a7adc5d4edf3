#include "sensors/sonar_lobe.h"

#include <algorithm>
#include <cmath>

#include "base/angle_units.h"

namespace robosim {

SonarLobe SonarLobe::polaroid() {
  // Far: the first zero of a piston of 38 mm at 49.4 kHz, sin θ = 1.22 · 6.95 mm / 38 mm, is at 12.9°.
  return {.on = true, .wall_rad = 42 * kRadPerDeg, .far_rad = 12.9 * kRadPerDeg, .range_m = 5, .edge_share = 0.5};
}

void SonarLobe::read(XmlReader& noise) {
  const bool is_given = noise.has("wall_deg");
  wall_rad = noise.angle("wall_deg", {0, 90}, wall_rad);
  far_rad = noise.angle("far_deg", {0, 90}, is_given && !on ? wall_rad : far_rad);
  range_m = noise.number("lobe_range_m", Bounds::positive(100), range_m);
  edge_share = noise.number("edge_share", Bounds::notNegative(1), edge_share);
  on = on || is_given;
}

double SonarLobe::angleAt(double target_m, SonarTarget target) const {
  const double wall = wall_rad + (far_rad - wall_rad) * std::min(1.0, target_m / range_m);
  return target == SonarTarget::face ? wall : wall * edge_share;
}

}  // namespace robosim
