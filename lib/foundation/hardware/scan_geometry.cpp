#include "hardware/scan_geometry.h"

#include <cmath>

namespace robosim {

using mrpt::math::TPose3D;

std::optional<ScanGeometry> toScanGeometry(const std::vector<Beam>& beams) {
  constexpr double kSame = 1e-9;
  const auto wrapped = [](double angle_rad) { return std::remainder(angle_rad, 2 * M_PI); };
  if (beams.size() < 2) return std::nullopt;
  const TPose3D& first = beams[0].robot_from_beam;
  // Accumulated steps would accumulate rounding errors, so the total angle is computed from the last beam, and the
  // first step only determines the number of full turns.
  const auto steps = static_cast<double>(beams.size() - 1);
  const double about_rad = steps * wrapped(beams[1].robot_from_beam.yaw - first.yaw);
  const double turned_rad = about_rad + wrapped(beams.back().robot_from_beam.yaw - first.yaw - about_rad);
  const double step_rad = turned_rad / steps;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const TPose3D& beam = beams[i].robot_from_beam;
    const double apart = std::abs(beam.x - first.x) + std::abs(beam.y - first.y) + std::abs(beam.z - first.z);
    const double astray = wrapped(beam.yaw - first.yaw - static_cast<double>(i) * step_rad);
    if (apart > kSame || std::abs(astray) > kSame || beam.pitch != 0 || beam.roll != 0) return std::nullopt;
  }
  if (std::abs(step_rad) < kSame || std::abs(turned_rad) > 2 * M_PI + kSame) return std::nullopt;
  TPose3D middle = first;
  middle.yaw = wrapped(first.yaw + turned_rad / 2);
  return ScanGeometry{middle, step_rad, std::abs(turned_rad)};
}

TPose3D panned(TPose3D robot_from_beam, double pan_rad) {
  robot_from_beam.yaw += pan_rad;
  return robot_from_beam;
}

}  // namespace robosim
