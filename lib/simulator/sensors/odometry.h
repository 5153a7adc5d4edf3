#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/registry.h"
#include "sensors/sensor.h"
#include "sensors/wheel_errors.h"

namespace robosim {

/// Drift of dead reckoning: the odometry model of Thrun, Burgard & Fox, *Probabilistic Robotics* (2005), §5.4, with
/// variances proportional to the distance (not its square), so that drift does not depend on the length of a time step.
struct OdometryNoise {
  bool on = false;
  double length_std_per_sqrt_m = 0.02;  ///< [m/√m]: error of the distance after a metre driven, [0, 10]
  double turn_std_per_sqrt_rad = 0.02;  ///< [rad/√rad]: error of the heading after a radian turned, [0, 10]
  double drift_std_per_sqrt_m = 0.01;   ///< [rad/√m]: error of the heading after a metre driven, [0, 10]
};

/// Wheel odometry: the pose since the start, integrated from the wheels' motion. Exact unless noise is on.
struct OdometryOptions {
  std::string label = "odometry";
  OdometryNoise noise;
  WheelErrors wheels;  ///< applied before the noise, if that is on

  /// Reads <odometry>.
  static OdometryOptions read(XmlReader&, const Mount&);
};

std::unique_ptr<Sensor> makeOdometry(const OdometryOptions&);

}  // namespace robosim
