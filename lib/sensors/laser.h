#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/range_noise.h"
#include "sensors/registry.h"
#include "sensors/sensor.h"

namespace robosim {

/// A level laser scanner; with one beam, the pointer of 2005.
struct LaserOptions {
  std::string label = "laser";
  mrpt::math::TPoint3D robot_from_laser;  ///< where the beams start, robot frame [m]
  double direction_rad = 0;               ///< where it looks, robot frame; the middle of a scan
  int beams = 181;  ///< [1, 10000], evenly spaced from right to left, first and last on the field's edges
  double field_of_view_rad = M_PI;  ///< (0°, 360°]; of no meaning for one beam
  double range_min_m = 0;           ///< [0, range_max_m): nearer things read this
  double range_max_m = 8;           ///< (0, 1000]: only things nearer than this are seen. 8 m: LMS200 in mm mode
  double no_return_m = 8;           ///< [range_max_m, 10000]: what a beam reads that meets nothing
  bool pans = false;                ///< turns with Command::laser_pan_rad
  RangeNoise noise;

  /// Reads <laser>.
  static LaserOptions read(XmlReader&);
  /// Reads 2005's <sensor> of type laser: one beam that turns by ±90° and reads the range + 1 unit when it meets
  /// nothing.
  static LaserOptions read2005(XmlReader&, const Mount&);
};

std::unique_ptr<Sensor> makeLaser(const LaserOptions&);

}  // namespace robosim
