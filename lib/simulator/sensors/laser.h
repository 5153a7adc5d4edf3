#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/laser_errors.h"
#include "sensors/laser_scanner.h"
#include "sensors/registry.h"
#include "sensors/sensor.h"

namespace robosim {

/// Planar laser scanner; with one beam, the laser pointer of 2005.
struct LaserOptions {
  std::string label = "laser";
  mrpt::math::TPoint3D robot_from_laser;  ///< origin of the beams, robot frame [m]
  double direction_rad = 0;               ///< middle of the scan, robot frame
  int beams = 181;  ///< [1, 10000], evenly spaced from right to left, first and last on the field's edges
  double field_of_view_rad = M_PI;  ///< (0°, 360°]; ignored for one beam
  double range_min_m = 0;           ///< [0, range_max_m): nearer objects read this
  double range_max_m = 8;           ///< (0, 1000]: only nearer objects are detected. 8 m: LMS200 in mm mode
  double no_return_m = 8;           ///< [range_max_m, 10000]: reading of a beam without a hit
  bool pans = false;                ///< turns with Command::laser_pan_rad
  LaserErrors errors;
  LaserTiming timing;

  /// Reads <laser>.
  static LaserOptions read(XmlReader&);
  /// Reads a 2005 <sensor> of type laser: one beam that pans by ±90° and reads the range + 1 unit without a hit.
  static LaserOptions read2005(XmlReader&, const Mount&);
};

std::unique_ptr<Sensor> makeLaser(const LaserOptions&);

}  // namespace robosim
