#pragma once
#include <memory>

#include "sensors/sensor.h"

namespace robosim {

/// Characteristic curve of an infrared triangulation sensor, V(d) = gain / (d + offset), read through a converter, and
/// converted back to a distance by the inverse of the curve. Equal errors of the voltage are therefore errors of the
/// distance that grow with (d + offset)². Nearer than `fold_m` the voltage falls again, linearly to 0 at the sensor,
/// and an object there is read as a far one. The set `gp2d12` is fitted to the two points of the data sheet of Sharp's
/// GP2D12, 0.4 V at 80 cm and 2.0 V more at 10 cm: gain 0.336 V·m, offset 0.04 m; its converter has 8 bits of 5 V.
/// Omitted: colour and angle of the surface, and the 38 ms between two measurements.
struct InfraredCurve {
  bool on = false;
  double gain_v_m = 0.336;    ///< (0, 100]
  double offset_m = 0.04;     ///< [0, 10]
  double voltage_std_v = 0;   ///< standard deviation, [0, 10]
  double voltage_step_v = 0;  ///< step of the converter, [0, 10]; 0: continuous
  double fold_m = 0;          ///< [0, 1]

  static InfraredCurve gp2d12();
  /// Reads the attributes of a <noise> element over the present values; those of the voltage switch the curve on.
  void read(XmlReader& noise);
  double voltageAt(double distance_m) const;
  /// Distance at which the curve has this voltage; infinite for none.
  double distanceAt(double voltage_v) const;
  /// The distance read for an object, or for none at infinity. @param gaussian error of the voltage, in deviations
  double read(double distance_m, double gaussian) const;
};

/// Applies the curve to the echoes of thin beams.
/// @param exact sensor of the beams with range_min_m = 0 @param range_min_m smallest reading
std::unique_ptr<Sensor> withInfraredCurve(std::unique_ptr<Sensor> exact, const InfraredCurve&, double range_min_m);

}  // namespace robosim
