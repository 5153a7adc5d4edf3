#include "sensors/compass_deviation.h"

#include <cmath>

#include "base/portable_math.h"

namespace robosim {

CompassDeviation CompassDeviation::read(XmlReader& noise) {
  CompassDeviation d;
  d.offset_rad = noise.angle("offset_deg", {-180, 180}, 0);
  d.hard_iron_rad = noise.angle("hard_iron_deg", {0, 90}, 0);
  d.hard_iron_at_rad = noise.angle("hard_iron_at_deg", {-360, 360}, 0);
  d.soft_iron_rad = noise.angle("soft_iron_deg", {0, 90}, 0);
  d.soft_iron_at_rad = noise.angle("soft_iron_at_deg", {-360, 360}, 0);
  return d;
}

double CompassDeviation::at(double heading_rad) const {
  double error_rad = offset_rad;
  if (hard_iron_rad != 0) error_rad += hard_iron_rad * portable::sin(heading_rad - hard_iron_at_rad);
  if (soft_iron_rad != 0) error_rad += soft_iron_rad * portable::sin(2 * (heading_rad - soft_iron_at_rad));
  return error_rad;
}

}  // namespace robosim
