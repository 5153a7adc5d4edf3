#pragma once
#include <cmath>
#include <vector>

#include <robosim/control/robot.h>

/// A vector in the robot's frame: x forward, y left.
struct Vector {
  double x = 0, y = 0;
  static Vector polar(double length, double angle_rad) {
    return {length * std::cos(angle_rad), length * std::sin(angle_rad)};
  }
  double length() const { return std::hypot(x, y); }
  double angle() const { return std::atan2(y, x); }
  Vector operator+(const Vector& other) const { return {x + other.x, y + other.y}; }
  Vector operator*(double factor) const { return {x * factor, y * factor}; }
  /// Of length 1; the zero vector stays what it is.
  Vector unit() const { return length() > 0 ? *this * (1 / length()) : *this; }
};

/// @name Readings of a foot-bot
///@{
/// Sum of the proximities of the 24 infrared sensors, 1 at contact and 0 at their range, as vectors towards what is
/// near.
Vector proximity(const robosim::Robot& robot);
/// Direction of the brightest light, of length 1; the zero vector in darkness.
Vector towardsLight(const robosim::Robot& robot);
/// Brightness under the robot, [0, 1]: front left, rear left, rear right, front right.
const std::vector<double>& ground(const robosim::Robot& robot);
///@}

/// Drives the wheels at two speeds [m/s].
void driveWheels(robosim::Robot& robot, double left_mps, double right_mps);

/// Steers along a vector: straight ahead for small angles, in a curve for larger ones, on the spot for the largest,
/// with two thresholds between a curve and a turn on the spot, so that the robot does not switch back and forth.
class Steering {
 public:
  explicit Steering(double speed_max_mps) : speed_max_mps_(speed_max_mps) {}
  /// @param wish direction; its length is the speed [m/s]
  void follow(const Vector& wish, robosim::Robot& robot);

 private:
  double speed_max_mps_;
  bool turns_on_the_spot_ = false;
};
