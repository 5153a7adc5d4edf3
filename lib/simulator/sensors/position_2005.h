#pragma once
#include "base/xml_reader.h"
#include "sensors/registry.h"

namespace robosim {

/// Mounting position and range of a 2005 <sensor>, in metres and in the robot frame. The file's x-, y- and z-relative
/// are relative to the robot's centre; <range> is given in <sensor> or in <position>.
struct Position2005 {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  double direction_rad = 0;
  double range_m = 0;

  static Position2005 read(XmlReader& sensor, const Mount& mount);
};

}  // namespace robosim
