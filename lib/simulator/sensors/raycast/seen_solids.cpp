#include "sensors/raycast/seen_solids.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Exceeds rounding errors of the bounds below, relative to lengths of about a metre.
constexpr double kSlack = 1e-9;
constexpr double kFarthest_m = 1e9;  ///< for areas of views without a range

/// Rectangle that covers the wedge.
Bounds2D boundsOf(const ViewFrame& frame, const ViewWedge& wedge) {
  const double reach_m = std::min(wedge.range_m, kFarthest_m);
  if (wedge.isAround()) {
    const double r = reach_m + wedge.spread_m;
    return {frame.x - r, frame.x + r, frame.y - r, frame.y + r};
  }
  const double aside_m = reach_m * std::min(wedge.slope_max, 1e3);
  const double left_x = frame.ahead_x * reach_m - frame.ahead_y * aside_m;
  const double left_y = frame.ahead_y * reach_m + frame.ahead_x * aside_m;
  const double right_x = frame.ahead_x * reach_m + frame.ahead_y * aside_m;
  const double right_y = frame.ahead_y * reach_m - frame.ahead_x * aside_m;
  return {frame.x + std::min({0.0, left_x, right_x}), frame.x + std::max({0.0, left_x, right_x}),
          frame.y + std::min({0.0, left_y, right_y}), frame.y + std::max({0.0, left_y, right_y})};
}

/// Sets the bounds of a circle. @return whether it may be seen
bool boundCircle(const ViewWedge& wedge, double per_edge, SeenSolid& s) {
  const double r = s.half_length_m;
  if (wedge.isAround()) {
    s.near_m = std::sqrt(s.x * s.x + s.y * s.y) - r - wedge.spread_m;
    return !(s.near_m > wedge.range_m);
  }
  s.near_m = s.x - r;
  if (!(s.x + r >= 0) || !(s.near_m <= wedge.range_m)) return false;
  if ((std::abs(s.y) - wedge.slope_max * s.x) * per_edge > r + kSlack) return false;
  if (s.near_m <= kSlack) return true;
  // Slopes of the two tangents from the origin.
  const double far = s.x * s.x - r * r;
  const double half = r * std::sqrt(far + s.y * s.y);
  const double per = 1 / far;
  s.slope_min = (s.x * s.y - half) * per;
  s.slope_max = (s.x * s.y + half) * per;
  return true;
}

/// Sets the bounds of a box. @return whether it may be seen
bool boundBox(const ViewWedge& wedge, double per_edge, SeenSolid& s) {
  const double reach_m = s.half_length_m + s.half_width_m;
  if (wedge.isAround()) {
    const double a = std::abs(s.x * s.axis_x + s.y * s.axis_y) - s.half_length_m;
    const double b = std::abs(s.y * s.axis_x - s.x * s.axis_y) - s.half_width_m;
    const double beyond_a = std::max(0.0, a), beyond_b = std::max(0.0, b);
    s.near_m = std::sqrt(beyond_a * beyond_a + beyond_b * beyond_b) - wedge.spread_m;
    return !(s.near_m > wedge.range_m);
  }
  if (!(s.x + reach_m >= 0) || !(s.x - reach_m <= wedge.range_m)) return false;
  if ((std::abs(s.y) - wedge.slope_max * s.x) * per_edge > reach_m + kSlack) return false;
  const double along_x = s.half_length_m * s.axis_x, along_y = s.half_length_m * s.axis_y;
  const double aside_x = -s.half_width_m * s.axis_y, aside_y = s.half_width_m * s.axis_x;
  const double x[4] = {s.x + along_x + aside_x, s.x + along_x - aside_x, s.x - along_x + aside_x,
                       s.x - along_x - aside_x};
  const double y[4] = {s.y + along_y + aside_y, s.y + along_y - aside_y, s.y - along_y + aside_y,
                       s.y - along_y - aside_y};
  double near = x[0], far = x[0];
  double beyond_left = kInfinity, beyond_right = kInfinity;  // of the corner that is farthest inside
  for (std::size_t i = 0; i < 4; ++i) {
    near = std::min(near, x[i]);
    far = std::max(far, x[i]);
    beyond_left = std::min(beyond_left, y[i] - wedge.slope_max * x[i]);
    beyond_right = std::min(beyond_right, -y[i] - wedge.slope_max * x[i]);
  }
  s.near_m = near;
  if (!(far >= 0) || !(near <= wedge.range_m) || beyond_left > kSlack || beyond_right > kSlack) return false;
  if (near <= kSlack) return true;
  double slope_min = kInfinity, slope_max = -kInfinity;
  for (std::size_t i = 0; i < 4; ++i) {
    const double slope = y[i] / x[i];
    slope_min = std::min(slope_min, slope);
    slope_max = std::max(slope_max, slope);
  }
  s.slope_min = slope_min;
  s.slope_max = slope_max;
  return true;
}

}  // namespace

void findSeenSolids(const Scene& scene, const ViewFrame& frame, const ViewWedge& wedge, BodyId owner,
                    std::vector<SeenSolid>& seen) {
  static thread_local std::vector<FoundSolid> found;
  found.clear();
  scene.findSolids(boundsOf(frame, wedge), found);
  const double per_edge = wedge.isAround() ? 0 : 1 / std::sqrt(1 + wedge.slope_max * wedge.slope_max);
  seen.clear();
  for (const FoundSolid& solid : found) {
    if (solid.body == owner) continue;
    const auto center = frame.toView({solid.center.x - frame.x, solid.center.y - frame.y});
    const auto axis = frame.toView(solid.axis);
    SeenSolid s{.x = center.x,
                .y = center.y,
                .axis_x = axis.x,
                .axis_y = axis.y,
                .half_length_m = solid.half_length_m,
                .half_width_m = solid.half_width_m,
                .low_m = solid.heights.z_min_m - frame.z,
                .high_m = solid.heights.z_max_m - frame.z,
                .body = solid.body};
    if (s.isCircle() ? boundCircle(wedge, per_edge, s) : boundBox(wedge, per_edge, s)) seen.push_back(s);
  }
  std::sort(seen.begin(), seen.end(), [](const SeenSolid& a, const SeenSolid& b) {
    return a.near_m != b.near_m ? a.near_m < b.near_m : a.body < b.body;
  });
}

}  // namespace robosim
