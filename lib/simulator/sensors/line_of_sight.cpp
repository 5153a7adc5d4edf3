#include "sensors/line_of_sight.h"

#include <cmath>

#include "base/portable_math.h"

namespace robosim {

bool isInSight(const Scene& scene, const mrpt::math::TPoint3D& from, const mrpt::math::TPoint3D& to, BodyId own,
               BodyId seen) {
  const auto way = to - from;
  const double distance_m = std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
  if (distance_m == 0) return true;
  const Hit hit = scene.castRay({from, way * (1 / distance_m)}, distance_m, own);
  return !hit || hit.body == seen;
}

double wrapped(double angle_rad) { return angle_rad - 2 * M_PI * std::ceil((angle_rad - M_PI) / (2 * M_PI)); }

}  // namespace robosim
