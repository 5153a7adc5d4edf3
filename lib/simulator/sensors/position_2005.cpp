#include "sensors/position_2005.h"

namespace robosim {

Position2005 Position2005::read(XmlReader& sensor, const Mount& mount) {
  Position2005 read;
  read.z_m = mount.robot_height_m / 2;
  auto position = sensor.child("position");
  const bool range_inside = position && position->has("range");
  XmlReader& with_range = range_inside ? *position : sensor;
  if (range_inside && sensor.has("range")) sensor.error("<range> is given here and in <position>; keep one");
  read.range_m = mount.unit_m * with_range.number("range", Bounds::positive(1e6));
  if (position) {
    read.x_m = mount.unit_m * position->number("x-relative", {-1e6, 1e6}, 0);
    read.y_m = mount.unit_m * position->number("y-relative", {-1e6, 1e6}, 0);
    read.z_m += mount.unit_m * position->number("z-relative", {-1e6, 1e6}, 0);
    read.direction_rad = position->number("dir-relative", {-1000, 1000}, 0);
    position->finish();
  }
  return read;
}

}  // namespace robosim
