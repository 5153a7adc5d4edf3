#pragma once
#include <map>
#include <vector>

#include "base/xml_reader.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Reads where the beams of a ring-like sensor sit, in the file's order: <at x_m y_m z_m angle_deg/> for one, and
/// <ring count radius_m z_m first_angle_deg/> for `count` of them evenly around, counter-clockwise, looking outwards.
/// Reports an error when there is none.
std::vector<Beam> readBeamMounts(XmlReader& sensor);

/// `robot_from_beam` of a level beam.
Beam levelBeam(double x_m, double y_m, double z_m, double angle_rad);

/// Which of the beams start at each height: those of one height can be asked together.
std::map<double, std::vector<std::size_t>> beamsByHeight(const std::vector<Beam>&);

/// Unit vector along which the beam looks, robot frame.
mrpt::math::TPoint3D directionOf(const Beam&);
mrpt::math::TPoint3D originOf(const Beam&);

/// Where an echo comes from that was heard along `direction` (a unit vector) of a sensor at `origin`, all in the
/// robot's frame.
inline mrpt::math::TPoint3Df pointAlong(const mrpt::math::TPoint3D& origin, const mrpt::math::TPoint3D& direction,
                                        double range_m) {
  const auto point = origin + direction * range_m;
  return {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)};
}

}  // namespace robosim
