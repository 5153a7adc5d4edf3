#include "rendering/free_areas.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// Least width of a drawn sector, which makes beams of zero width visible.
constexpr double kThinBeam_rad = 0.02;

}  // namespace

std::vector<std::vector<TPoint2D>> freeAreas(const RobotSnapshot& robot, const SensorInfo& sensor, const Echoes& echoes,
                                             double arc_piece_m) {
  const auto to_world = [&](double x, double y) { return robot.world_from_robot.composePoint(TPoint2D(x, y)); };
  std::vector<std::vector<TPoint2D>> areas;
  if (sensor.kind == SensorKind::laser && echoes.size() > 2) {
    const auto& at = sensor.beams.front().robot_from_beam;
    auto& area = areas.emplace_back();
    area.push_back(to_world(at.x, at.y));
    for (const auto& echo : echoes) area.push_back(to_world(echo.point_m.x, echo.point_m.y));
    return areas;
  }
  const double half_rad = std::max(kThinBeam_rad, sensor.beam_width_rad) / 2;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const auto& at = sensor.beams[i].robot_from_beam;
    const double middle_rad = at.yaw + (sensor.pans ? robot.laser_pan_rad : 0);
    const double range_m = echoes[i].range_m;
    const int pieces = std::clamp(static_cast<int>(2 * half_rad * range_m / arc_piece_m), 1, 12);
    auto& area = areas.emplace_back();
    area.push_back(to_world(at.x, at.y));
    for (int k = 0; k <= pieces; ++k) {
      const double angle_rad = middle_rad - half_rad + 2 * half_rad * k / pieces;
      area.push_back(to_world(at.x + range_m * std::cos(angle_rad), at.y + range_m * std::sin(angle_rad)));
    }
  }
  return areas;
}

}  // namespace robosim
