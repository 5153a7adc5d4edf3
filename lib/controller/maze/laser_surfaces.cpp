#include "maze/laser_surfaces.h"

#include <cmath>

#include "base/portable_math.h"
#include "control/echo.h"

namespace robosim {
namespace {

constexpr std::size_t kNeighbours = 4;   // on each side
constexpr double kLengthMax_m = 1.0;     // of the line: longer ones are hit at a flat angle, or lie on two surfaces
constexpr double kResidualMax_m = 0.04;  // root mean square distance from the line
constexpr double kStd_m = 0.02;          // with the errors of the map

}  // namespace

void addLaserSurfaces(const SensorInfo& sensor, const Echoes& echoes, std::size_t stride,
                      std::vector<SurfacePoint>& points) {
  for (std::size_t i = kNeighbours; i + kNeighbours < echoes.size(); i += stride) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (std::size_t k = i - kNeighbours; k <= i + kNeighbours; ++k) {
      if (!isEcho(sensor, echoes[k])) continue;
      const double px = echoes[k].point_m.x, py = echoes[k].point_m.y;
      ++n;
      x += px;
      y += py;
      xx += px * px;
      xy += px * py;
      yy += py * py;
    }
    if (!isEcho(sensor, echoes[i]) || n < 2 * kNeighbours) continue;
    const mrpt::math::TPoint2D middle(x / n, y / n);
    xx = xx / n - middle.x * middle.x;
    xy = xy / n - middle.x * middle.y;
    yy = yy / n - middle.y * middle.y;
    // Eigenvalues of the covariance: variances along the line and across it.
    const double half = (xx + yy) / 2, spread = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
    const double along = half + spread, across = half - spread;
    if (across > kResidualMax_m * kResidualMax_m || across > along / 16 || 12 * along > kLengthMax_m * kLengthMax_m) {
      continue;
    }
    const double angle = portable::atan2(2 * xy, xx - yy) / 2;
    const auto direction = portable::sincos(angle);
    mrpt::math::TPoint2D normal(-direction.sin, direction.cos);
    const auto& beam = sensor.beams[i].robot_from_beam;
    if (normal.x * (beam.x - middle.x) + normal.y * (beam.y - middle.y) < 0) normal *= -1;
    points.push_back({middle, normal, kStd_m});
  }
}

}  // namespace robosim
