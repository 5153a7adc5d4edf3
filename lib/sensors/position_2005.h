#pragma once
#include "base/xml_reader.h"
#include "sensors/registry.h"

namespace robosim {

/// What a 2005 <sensor> says of its place and reach, in metres and in the robot's frame. The file's x-, y- and
/// z-relative count from the robot's centre; <range> stands in <sensor> or inside <position>.
struct Position2005 {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  double direction_rad = 0;
  double range_m = 0;

  static Position2005 read(XmlReader& sensor, const Mount& mount);
};

}  // namespace robosim
