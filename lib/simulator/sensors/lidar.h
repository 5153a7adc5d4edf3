#pragma once
#include <memory>
#include <string>

#include <mrpt/math/TPoint3D.h>

#include "base/angle_units.h"
#include "base/xml_reader.h"
#include "sensors/laser_errors.h"
#include "sensors/laser_scanner.h"
#include "sensors/sensor.h"

namespace robosim {

/// Multi-layer laser scanner: in each of `beams` directions of a sweep about the vertical, one beam in each layer. The
/// layers are cones of evenly spaced elevations. Beams hit solids and the floor. Echoes are in the order of layers,
/// from the lowest, each counter-clockwise.
///
/// While the robot moves, all beams of a direction start from the pose at their own time, as those of a scanner with
/// one layer (LaserTiming). Its errors are those of LaserErrors for beams without divergence, and independent of the
/// returned light.
struct LidarOptions {
  std::string label = "lidar";
  mrpt::math::TPoint3D robot_from_lidar;        ///< origin of the beams, robot frame [m]
  double direction_rad = 0;                     ///< middle of the sweep, robot frame
  int layers = 16;                              ///< [1, 128]
  int beams = 360;                              ///< in a layer, [1, 4096]; layers · beams <= ScanErrors::kBeamsMax
  double field_of_view_rad = 2 * M_PI;          ///< (0°, 360°]: beam i is at its part (i + 0.5) / beams
  double elevation_min_rad = -15 * kRadPerDeg;  ///< of the lowest layer, [-89°, 89°]; a single layer is in the middle
  double elevation_max_rad = 15 * kRadPerDeg;   ///< of the highest layer, [elevation_min, 89°]
  double range_min_m = 0;                       ///< [0, range_max_m): nearer objects read this
  double range_max_m = 100;                     ///< (0, 1000]: only nearer objects are detected
  double no_return_m = 100;                     ///< [range_max_m, 10000]: reading of a beam without a hit
  LaserErrors errors;
  LaserTiming timing;  ///< without interlace

  /// Reads <lidar>.
  static LidarOptions read(XmlReader&);
};

std::unique_ptr<Sensor> makeLidar(const LidarOptions&);

}  // namespace robosim
