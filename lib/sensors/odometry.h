#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/sensor.h"

namespace robosim {

/// How dead reckoning drifts: the odometry model of Thrun, Burgard & Fox, *Probabilistic Robotics* (2005), §5.4, with
/// variances that grow with the way (not its square), so that drift does not depend on the length of a time step.
struct OdometryNoise {
  bool on = false;
  double length_std_per_sqrt_m = 0.02;  ///< [m/√m]: error of the way after a metre driven, [0, 10]
  double turn_std_per_sqrt_rad = 0.02;  ///< [rad/√rad]: error of the heading after a radian turned, [0, 10]
  double drift_std_per_sqrt_m = 0.01;   ///< [rad/√m]: error of the heading after a metre driven, [0, 10]
};

/// Wheel odometry: the pose since the start, as the wheels tell it. Exact unless noise is on.
struct OdometryOptions {
  std::string label = "odometry";
  OdometryNoise noise;

  /// Reads <odometry>.
  static OdometryOptions read(XmlReader&);
};

std::unique_ptr<Sensor> makeOdometry(const OdometryOptions&);

}  // namespace robosim
