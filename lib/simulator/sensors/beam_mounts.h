#pragma once
#include <map>
#include <vector>

#include "base/xml_reader.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Reads the mounting poses of a sensor's beams, in the file's order: <at x_m y_m z_m angle_deg/> for a single beam,
/// and <ring count radius_m z_m first_angle_deg/> for `count` beams at equal angles, counter-clockwise, facing
/// outwards. Reports an error when there is none.
std::vector<Beam> readBeamMounts(XmlReader& sensor);

/// Reads a position from x_m, y_m and z_m, 0 by default, each in [-bound_m, bound_m].
mrpt::math::TPoint3D readPosition(XmlReader&, double bound_m = 100);

/// Planar beam at a pose in the robot frame.
Beam planarBeam(double x_m, double y_m, double z_m, double angle_rad);

/// Indices of the beams by height: beams at one height can be cast together.
std::map<double, std::vector<std::size_t>> beamsByHeight(const std::vector<Beam>&);

}  // namespace robosim
