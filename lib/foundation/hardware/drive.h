#pragma once
#include <cstdint>

namespace robosim {

/// How the wheels or tracks of a robot move it.
enum class DriveKind : std::uint8_t {
  differential,  ///< two driven wheels: ahead, and turning on the spot
  omni,          ///< omnidirectional, such as on mecanum wheels: also sideways, whatever the heading
  car,           ///< steered front wheels (Ackermann): turns only while it drives
  tracked,       ///< two tracks, or wheels that are skid-steered: turns by slipping sideways
};

/// Drive of a robot. The origin of the robot lies between the wheels of a differential drive, in the middle of those of
/// an omnidirectional one, and in the middle of tracks; the rear axle of a car is icr_x_m ahead of it.
struct Drive {
  DriveKind kind = DriveKind::differential;
  /// @name car
  ///@{
  double wheelbase_m = 0;          ///< from the rear axle to the front axle, > 0
  double steering_max_rad = 0;     ///< of the middle of the front axle, to either side, (0, π/2)
  double steering_rate_radps = 0;  ///< with which the front wheels are steered; 0: at once
  ///@}
  /// @name tracked
  /// Instantaneous centres of rotation (ICR) of the tracks on the ground: Martínez, Mandow, Morales, Pedraza &
  /// García-Cerezo, "Approximating kinematics for tracked mobile robots", Int. J. Robotics Research 24(10), 2005,
  /// with equal centres on both sides.
  ///@{
  /// Distance of the two tracks' ICRs by the distance of the tracks (the reciprocal of the paper's steering
  /// efficiency), [1, 10]: tracks turn the robot by a share of 1 / track_factor of what they would without slip.
  double track_factor = 1;
  double assumed_factor = 1;  ///< track_factor by which the robot's controller and odometry compute, [1, 10]
  double icr_x_m = 0;         ///< where the robot turns about, ahead of its origin, [-10, 10]; car: of its rear axle
  ///@}
  /// Turn of the robot by the commanded one.
  double turnShare() const { return assumed_factor / track_factor; }
  bool operator==(const Drive&) const = default;
};

/// "differential", "omni", "car", "tracked".
constexpr const char* nameOf(DriveKind kind) {
  switch (kind) {
    case DriveKind::differential:
      return "differential";
    case DriveKind::omni:
      return "omni";
    case DriveKind::car:
      return "car";
    case DriveKind::tracked:
      return "tracked";
  }
  return "";
}

}  // namespace robosim
