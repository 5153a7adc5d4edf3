#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/registry.h"
#include "sensors/sensor.h"

namespace robosim {

/// Attenuation of a heat source of temperature T with the distance d between the centres of robot and source.
enum class HeatLaw {
  linear,   ///< T · (1 − d / range): the law of the 2005 report's table
  inverse,  ///< T / d, d in length units of the file and at least 0.01: the law of its text
};

/// Heat sensor: the sum of all sources within range. Walls do not attenuate heat.
struct HeatOptions {
  std::string label = "heat";
  HeatLaw law = HeatLaw::linear;
  double range_max_m = 1.5;  ///< (0, 1e6]
  double unit_m = 1;         ///< the inverse law's unit of distance
  double noise_std = 0;      ///< standard deviation of the reading; 0: exact
  /// Time constant of the sensor's own temperature, [0, 3600]; 0: none. A reading approaches the heat by the share
  /// T / (T + lag_s) in each time step T: a thermal sensor of first order, by the implicit Euler method. Its noise then
  /// is that of a recursive filter, with the same standard deviation. The first reading is settled.
  double lag_s = 0;

  /// Reads <heat>.
  static HeatOptions read(XmlReader&);
  /// Reads a 2005 <sensor> of type heat.
  static HeatOptions read2005(XmlReader&, const Mount&);
};

std::unique_ptr<Sensor> makeHeat(const HeatOptions&);

/// Contribution of a source of temperature `heat_celsius` at a distance; 0 beyond the range.
double heatAt(const HeatOptions&, double heat_celsius, double distance_m);

}  // namespace robosim
