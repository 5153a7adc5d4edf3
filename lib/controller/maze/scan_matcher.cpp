#include "maze/scan_matcher.h"

#include <cmath>

#include "base/portable_math.h"

namespace robosim {
namespace {

constexpr double kGate_m = 0.3;  // farther surfaces are others

/// The point in the frame of the pose.
SurfacePoint placed(const SurfacePoint& point, const mrpt::math::TPose2D& pose) {
  const auto heading = portable::sincos(pose.phi);
  const auto turned = [&](const mrpt::math::TPoint2D& p) {
    return mrpt::math::TPoint2D(heading.cos * p.x - heading.sin * p.y, heading.sin * p.x + heading.cos * p.y);
  };
  return {turned(point.point_m) + mrpt::math::TPoint2D(pose.x, pose.y), turned(point.normal), point.std_m};
}

}  // namespace

void ScanMatcher::match(const std::vector<SurfacePoint>& points, PoseFilter& filter) {
  for (const auto& point : points) {
    const mrpt::math::TPose2D pose = filter.startFromRobot();
    const SurfacePoint here = placed(point, pose);
    const auto surface = map_.nearest(here);
    if (!surface) continue;
    const auto& n = surface->normal;
    const double off = dot(n, surface->point_m - here.point_m);
    if (std::abs(off) > kGate_m) continue;
    const double arm_x = here.point_m.x - pose.x, arm_y = here.point_m.y - pose.y;
    filter.correct({n.x, n.y, n.y * arm_x - n.x * arm_y}, off, point.std_m);
  }
  for (const auto& point : points) map_.add(placed(point, filter.startFromRobot()));
}

}  // namespace robosim
