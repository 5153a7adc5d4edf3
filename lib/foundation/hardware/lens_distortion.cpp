#include "hardware/lens_distortion.h"

#include <cmath>

namespace robosim {

LensDistortion::Point LensDistortion::distort(const Point& p) const {
  const double r2 = p.x * p.x + p.y * p.y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {p.x * radial + 2 * p1 * p.x * p.y + p2 * (r2 + 2 * p.x * p.x),
          p.y * radial + p1 * (r2 + 2 * p.y * p.y) + 2 * p2 * p.x * p.y};
}

bool LensDistortion::undistort(const Point& shown, Point& ideal) const {
  ideal = shown;
  for (int i = 0; i < 100; ++i) {
    const Point at = distort(ideal);
    const double dx = shown.x - at.x, dy = shown.y - at.y;
    ideal.x += dx;
    ideal.y += dy;
    if (std::abs(dx) + std::abs(dy) < 1e-9) return true;
    if (!(std::abs(ideal.x) + std::abs(ideal.y) < 1e3)) return false;
  }
  return false;
}

}  // namespace robosim
