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

}  // namespace robosim
