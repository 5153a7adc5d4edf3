#pragma once
#include "base/xml_reader.h"
#include "sensors/sensor.h"

namespace robosim {

/// Systematic errors of the odometry of a differential drive (Borenstein & Feng, "Measurement and correction of
/// systematic odometry errors in mobile robots", IEEE Trans. Robotics and Automation 12(6), 1996: E_d and E_b),
/// and slip of its wheels, which that paper lists among the non-systematic errors. The mean diameter of the
/// wheels is exact, as the paper assumes. Omitted: uneven floors, castors, and the resolution of the encoders.
struct WheelErrors {
  double diameter_ratio = 1;   ///< E_d: actual diameter of the right wheel by that of the left one, [0.5, 2]
  double wheelbase_ratio = 1;  ///< E_b: actual wheelbase by the nominal one, [0.5, 2]
  double wheelbase_m = 0.33;   ///< nominal wheelbase, (0, 100]
  /// Growth of the share of a turn by which the wheels slip with the turn rate [1/(rad/s)], [0, 10]: at ω the wheels
  /// turn the robot's odometry 1 + turn_slip · |ω| times as far as the robot.
  double turn_slip_s = 0;
  double contact_slip = 0;  ///< share of a blocked motion that the wheels make, slipping, [0, 1]

  /// Reads the attributes of a <noise> element. The default wheelbase is 1.25 radii of the robot, as of a Pioneer 3-DX.
  static WheelErrors read(XmlReader& noise, double robot_radius_m);
  bool isNone() const { return diameter_ratio == 1 && wheelbase_ratio == 1 && turn_slip_s == 0 && contact_slip == 0; }
  /// The motion that the nominal wheels would have made, according to the encoders.
  /// @param blocked_m length of the commanded path that the robot could not drive, signed
  Motion measured(const Motion& true_motion, double blocked_m, double period_s) const;
};

}  // namespace robosim
