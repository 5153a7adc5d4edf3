#pragma once
#include <string>

namespace robosim::arcos {

/// What ARCOS programs assume about a robot type: ARIA compiles such a set in for each subclass, and the packets of the
/// robot must agree with it. Read from `<arcos>` of a robot type (doc/world_file.md).
struct Parameters {
  std::string subclass;               ///< "p3dx": selects the set of parameters in ARIA
  double distance_unit_mm = 1;        ///< unit of odometry in SIPs
  double turn_radpmm = 0.0056;        ///< turn rate [rad/s] = half the difference of the wheel speeds [mm/s] × this
  double wheel_speed_unit_mmps = 20;  ///< unit of the wheel speeds of VEL2
  double speed_mmps = 1000;           ///< initial maximum speed; a program may set up to the type's limits
  double turn_degps = 100;            ///< initial maximum turn rate
  double accel_mmps2 = 300;           ///< initial acceleration and deceleration
  double turn_accel_degps2 = 100;
  int front_bumpers = 0, rear_bumpers = 0;  ///< segments, [0, 7]
  bool has_front_sonar = true, has_rear_sonar = true;
  double encoder_ticks_per_mm = 128;
  double battery_volts = 13;  ///< without a simulated battery
  double low_battery_volts = 11.5;
  bool operator==(const Parameters&) const = default;
};

/// Time between two SIPs: SipCycle of the CONFIG packet.
constexpr double kCycle_s = 0.1;
/// Units of heading in a SIP.
constexpr int kHeadingUnitsPerTurn = 4096;
/// A robot stops when it has received no valid packet for this time.
constexpr int kWatchdog_ms = 2000;
/// First port of simulated robots, and that of ARIA's programs by default.
constexpr int kDefaultPort = 8101;

}  // namespace robosim::arcos
