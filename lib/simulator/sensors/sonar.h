#pragma once
#include <memory>
#include <vector>

#include "base/angle_units.h"
#include "base/xml_reader.h"
#include "sensors/registry.h"
#include "sensors/sensor.h"
#include "sensors/sonar_firing.h"
#include "sensors/sonar_noise.h"

namespace robosim {

/// Model of one sonar's beam.
enum class SonarModel {
  sector,  ///< the exact nearest point of any object inside the planar wedge
  rays,    ///< the nearest hit of a bundle of rays that fills the cone, in 3D
};

/// A ring of sonars.
struct SonarOptions {
  std::string label = "sonar";
  SonarModel model = SonarModel::sector;
  std::vector<Beam> beams;                  ///< in the order of the readings
  double range_min_m = 0;                   ///< [0, range_max_m): nearer objects read this
  double range_max_m = 5;                   ///< (0, 100]: only nearer objects return an echo
  double no_echo_m = 5;                     ///< [range_max_m, 1000]: reading without an echo
  double beam_width_rad = 20 * kRadPerDeg;  ///< full angle of the cone, (0°, 120°]; 2005: 20°
  int rays = 19;                            ///< for the model `rays`, [1, 1000]; 1: the axis only
  SonarFiring firing;
  SonarNoise noise;

  std::size_t rayCount() const;

  /// Reads <sonar>. @throws nothing: faults go to the reader's list.
  static SonarOptions read(XmlReader&);
  /// Reads a 2005 <sensor> of type sonar. Its 8 (mode 1, front) or 16 (mode 2) sonars are mounted as in Table 1 of the
  /// 2005 report: on a ring of the robot's radius about its centre, numbered from its right over its front to its left
  /// and around its back, at the height of <z-relative> above the robot's centre. No echo reads the range + 1 unit.
  static SonarOptions read2005(XmlReader&, const Mount&);
};

std::unique_ptr<Sensor> makeSonar(const SonarOptions&);

}  // namespace robosim
