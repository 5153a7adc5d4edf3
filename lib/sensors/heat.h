#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/registry.h"
#include "sensors/sensor.h"

namespace robosim {

/// How the heat of a source fades with the distance d between the robot's centre and the source's.
enum class HeatLaw {
  linear,   ///< T · (1 − d / range): what the 2005 report's own table follows
  inverse,  ///< T / d, d in length units of the file: what its text says; d counts as 0.01 units at least
};

/// One number: the sum over all sources within range. Walls do not stop heat.
struct HeatOptions {
  std::string label = "heat";
  HeatLaw law = HeatLaw::linear;
  double range_max_m = 1.5;  ///< (0, 1e6]
  double unit_m = 1;         ///< the inverse law's unit of distance
  double noise_std = 0;      ///< standard deviation of the reading; 0: exact

  /// Reads <heat>.
  static HeatOptions read(XmlReader&);
  /// Reads 2005's <sensor> of type heat.
  static HeatOptions read2005(XmlReader&, const Mount&);
};

std::unique_ptr<Sensor> makeHeat(const HeatOptions&);

/// What a source of temperature `heat_celsius` adds at a distance; 0 beyond the range.
double heatAt(const HeatOptions&, double heat_celsius, double distance_m);

}  // namespace robosim
