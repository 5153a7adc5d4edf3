#pragma once
#include "base/xml_reader.h"
#include "hardware/drive.h"
#include "sensors/sensor.h"

namespace robosim {

/// Systematic errors of a robot's odometry, and slip of its wheels.
///  * differential: Borenstein & Feng, "Measurement and correction of systematic odometry errors in mobile robots",
///  IEEE
///    Trans. Robotics and Automation 12(6), 1996: E_d and E_b, and slip, which that paper lists among the
///    non-systematic errors. The mean diameter of the wheels is exact, as the paper assumes.
///  * omni: the same of four mecanum wheels (kinematics: Muir & Neuman, "Kinematic modeling for feedback control of an
///    omnidirectional wheeled mobile robot", IEEE ICRA 1987), whose rollers also slip sideways.
///  * car: odometry from the way of the rear axle and the measured angle of the front wheels, with its offset.
///  * tracked: the errors of a differential drive, and turns by Drive::assumed_factor; tracks do not measure the
///  sideways
///    motion of the robot (Drive::icr_x_m).
/// Omitted: uneven floors, castors, and the resolution of the encoders.
struct WheelErrors {
  /// @name differential, omni, tracked
  ///@{
  double diameter_ratio = 1;  ///< E_d: actual diameter of the right wheels by that of the left ones, [0.5, 2]
  /// Nominal distance of the wheels, (0, 100]; omni: half the sum of distance left to right and front to rear, twice.
  double wheelbase_m = 0.33;
  /// Growth of the share of a turn by which the wheels slip with the turn rate [1/(rad/s)], [0, 10]: at ω the wheels
  /// turn the robot's odometry 1 + turn_slip · |ω| times as far as the robot.
  double turn_slip_s = 0;
  ///@}
  double wheelbase_ratio = 1;      ///< E_b: actual wheelbase by the nominal one, [0.5, 2]; car: of Drive::wheelbase_m
  double contact_slip = 0;         ///< share of a blocked motion that the wheels make, slipping, [0, 1]
  double lateral_slip = 0;         ///< omni: by which share the wheels travel farther sideways than the robot, [0, 1]
  double steering_offset_rad = 0;  ///< car: measured less actual steering angle, [-10°, 10°]
  Drive drive{};

  /// Exact ones of a robot. Default of the wheelbase: 1.25 radii, as of a Pioneer 3-DX; omni: 2.5 radii.
  static WheelErrors ofRobot(double robot_radius_m, const Drive& drive);
  /// Reads the attributes of a <noise> element that apply to the robot's drive.
  static WheelErrors read(XmlReader& noise, double robot_radius_m, const Drive& drive = {});
  /// The same but the nominal wheelbase, of a sensor that knows it.
  void readErrors(XmlReader& noise);
  bool isNone() const;
  /// The motion that the nominal wheels would have made, according to the encoders.
  /// @param blocked part of the commanded path that the robot could not drive
  Motion measured(const Motion& true_motion, const Motion& blocked, double period_s) const;

 private:
  Motion measuredByCar(const Motion& wheels) const;
};

}  // namespace robosim
