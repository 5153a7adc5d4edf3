#include "footbot.h"

#include <algorithm>
#include <variant>

namespace {

constexpr double kWheelbase_m = 0.14;
constexpr double kDegree = M_PI / 180;
constexpr double kStraight_rad = 10 * kDegree, kSoftAgain_rad = 70 * kDegree, kHard_rad = 90 * kDegree;

const std::vector<double>& valuesOf(const robosim::Robot& robot, const char* label) {
  return std::get<robosim::Values>(*robot.measurement(label)).values;
}

/// Of sensor `i` of 24.
double angleOf(std::size_t i) { return (7.5 + 15.0 * static_cast<double>(i)) * kDegree; }

}  // namespace

Vector proximity(const robosim::Robot& robot) {
  Vector sum;
  const double range_m = robot.sensor(robosim::SensorKind::infrared)->range_max_m;
  const auto& echoes = robot.infrared();
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    sum = sum + Vector::polar(std::max(0.0, 1 - static_cast<double>(echoes[i].range_m) / range_m), angleOf(i));
  }
  return sum;
}

Vector towardsLight(const robosim::Robot& robot) {
  Vector sum;
  const auto& light = valuesOf(robot, "light");
  for (std::size_t i = 0; i < light.size(); ++i) sum = sum + Vector::polar(light[i], angleOf(i));
  return sum.unit();
}

const std::vector<double>& ground(const robosim::Robot& robot) { return valuesOf(robot, "ground"); }

void driveWheels(robosim::Robot& robot, double left_mps, double right_mps) {
  robot.drive((left_mps + right_mps) / 2, (right_mps - left_mps) / kWheelbase_m);
}

void Steering::follow(const Vector& wish, robosim::Robot& robot) {
  const double angle_rad = wish.angle(), off_rad = std::abs(angle_rad);
  turns_on_the_spot_ = off_rad > (turns_on_the_spot_ ? kSoftAgain_rad : kHard_rad);
  double inner_mps = std::min(wish.length(), speed_max_mps_), outer_mps = inner_mps;
  if (turns_on_the_spot_) {
    inner_mps = -speed_max_mps_;
    outer_mps = speed_max_mps_;
  } else if (off_rad > kStraight_rad) {
    outer_mps *= 1 + off_rad / kHard_rad;
    inner_mps *= 1 - off_rad / kHard_rad;
  }
  if (angle_rad > 0) {
    driveWheels(robot, inner_mps, outer_mps);
  } else {
    driveWheels(robot, outer_mps, inner_mps);
  }
}
