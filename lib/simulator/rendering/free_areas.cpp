#include "rendering/free_areas.h"

#include <algorithm>
#include <cmath>

#include "hardware/numbered_quantities.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// Least width of a drawn sector, which makes beams of zero width visible.
constexpr double kThinBeam_rad = 0.02;

constexpr int kCirclePieces = 72;

}  // namespace

std::vector<std::vector<TPoint2D>> sightLines(const RobotSnapshot& robot, const SensorInfo& sensor,
                                              const Measurement& measurement) {
  std::vector<std::vector<TPoint2D>> lines;
  const auto to_world = [&](double x, double y) { return robot.world_from_robot.composePoint(TPoint2D(x, y)); };
  if (const auto* beacons = std::get_if<BeaconRanges>(&measurement)) {
    for (std::size_t i = 0; i < beacons->range_m.size() && i < sensor.beams.size(); ++i) {
      const double range_m = beacons->range_m[i];
      if (range_m >= sensor.no_echo_m) continue;
      const auto& at = sensor.beams[i].robot_from_beam;
      auto& circle = lines.emplace_back();
      for (int k = 0; k <= kCirclePieces; ++k) {
        const double angle_rad = 2 * M_PI * k / kCirclePieces;
        circle.push_back(to_world(at.x + range_m * std::cos(angle_rad), at.y + range_m * std::sin(angle_rad)));
      }
    }
  } else if (const auto* values = std::get_if<Values>(&measurement); values && sightingSize(sensor) > 0) {
    const auto at = sensor.beams.empty() ? mrpt::math::TPose3D() : sensor.beams.front().robot_from_beam;
    for (std::size_t i = 0; i + 2 < values->values.size(); i += sightingSize(sensor)) {
      if (values->values[i] < 0) continue;
      const double range_m = values->values[i + 1], angle_rad = at.yaw + values->values[i + 2];
      lines.push_back(
          {to_world(at.x, at.y), to_world(at.x + range_m * std::cos(angle_rad), at.y + range_m * std::sin(angle_rad))});
    }
  }
  return lines;
}

std::vector<std::vector<TPoint2D>> freeAreas(const RobotSnapshot& robot, const SensorInfo& sensor, const Echoes& echoes,
                                             double arc_piece_m) {
  const auto to_world = [&](double x, double y) { return robot.world_from_robot.composePoint(TPoint2D(x, y)); };
  std::vector<std::vector<TPoint2D>> areas;
  if (sensor.beams.empty()) return areas;
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
