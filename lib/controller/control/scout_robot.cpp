#include "control/scout_robot.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/angle_units.h"
#include "base/portable_pose.h"

namespace robosim {
namespace {

constexpr double kTenthInch_m = 0.00254;
constexpr double kTenthDeg_rad = 0.1 * kRadPerDeg;
/// A wheel's travel for a turn of one radian [m]: half the Scout's track, from Nomadic's 0.118597 inches a degree.
constexpr double kHalfTrack_m = toDegrees(0.118597 * 0.0254);

long toTenthInches(double metres) { return std::lround(metres / kTenthInch_m); }

long toTenthDegrees(double angle_rad) {
  const long tenths = std::lround(angle_rad / kTenthDeg_rad) % 3600;
  return tenths < 0 ? tenths + 3600 : tenths;
}

/// Converts two wheels' distances or speeds [tenths of an inch] to the motion of the robot's centre.
struct Wheels {
  double right, left;
  double way() const { return (right + left) / 2 * kTenthInch_m; }
  double turn() const { return (right - left) / 2 * kTenthInch_m / kHalfTrack_m; }
  /// The faster wheel's, as a limit for the robot: along the way, and turning on the spot.
  double wayLimit() const { return std::max(right, left) * kTenthInch_m; }
  double turnLimit() const { return wayLimit() / kHalfTrack_m; }
};

}  // namespace

ScoutRobot::ScoutRobot(Robot& robot) : robot_(robot), drive_(robot) { sonar_on_.fill(true); }

ScoutRobot::ScoutRobot(Robot& robot, StepClock& clock) : ScoutRobot(robot) { clock_ = &clock; }

int ScoutRobot::vm(int translation, int rotation) {
  drive_.setSpeed(translation * kTenthInch_m);
  drive_.setTurn(rotation * kTenthDeg_rad);
  return 1;
}

int ScoutRobot::vm(int right, int left, int) {
  const Wheels wheels{double(right), double(left)};
  drive_.setSpeed(wheels.way());
  drive_.setTurn(wheels.turn());
  return 1;
}

int ScoutRobot::pr(int translation, int rotation) {
  drive_.moveBy(translation * kTenthInch_m);
  drive_.turnBy(rotation * kTenthDeg_rad);
  return 1;
}

int ScoutRobot::pr(int right, int left, int) {
  const Wheels wheels{double(right), double(left)};
  drive_.moveBy(wheels.way());
  drive_.turnBy(wheels.turn());
  return 1;
}

int ScoutRobot::sp(int translation, int rotation) {
  drive_.limitWay({translation * kTenthInch_m, drive_.wayLimits().accel, drive_.wayLimits().decel});
  drive_.limitTurn({rotation * kTenthDeg_rad, drive_.turnLimits().accel, drive_.turnLimits().decel});
  return 1;
}

int ScoutRobot::sp(int right, int left, int) {
  const Wheels wheels{double(right), double(left)};
  drive_.limitWay({wheels.wayLimit(), drive_.wayLimits().accel, drive_.wayLimits().decel});
  drive_.limitTurn({wheels.turnLimit(), drive_.turnLimits().accel, drive_.turnLimits().decel});
  return 1;
}

int ScoutRobot::ac(int translation, int rotation) {
  const double way = translation * kTenthInch_m, turn = rotation * kTenthDeg_rad;
  drive_.limitWay({drive_.wayLimits().speed_max, way, way});
  drive_.limitTurn({drive_.turnLimits().speed_max, turn, turn});
  return 1;
}

int ScoutRobot::ac(int right, int left, int) {
  const Wheels wheels{double(right), double(left)};
  drive_.limitWay({drive_.wayLimits().speed_max, wheels.wayLimit(), wheels.wayLimit()});
  drive_.limitTurn({drive_.turnLimits().speed_max, wheels.turnLimit(), wheels.turnLimit()});
  return 1;
}

int ScoutRobot::st() {
  drive_.stop();
  return 1;
}

int ScoutRobot::ws(bool translation, bool rotation, bool, int timeout_s) {
  const double until = robot_.time() + timeout_s;
  const auto moves = [](bool is_considered, double to_go, double commanded, double measured) {
    return is_considered && (std::abs(to_go) > 1e-4 || commanded != 0 || measured != 0);
  };
  for (;;) {
    const Odometry& odometry = robot_.odometry();
    if (!moves(translation, drive_.wayToGo(), drive_.speed(), odometry.speed_mps) &&
        !moves(rotation, drive_.turnToGo(), drive_.turnSpeed(), odometry.turn_radps)) {
      return 1;
    }
    if (timeout_s > 0 && robot_.time() >= until) return 0;
    wait("ws");
  }
}

int ScoutRobot::dp(int x, int y) {
  const mrpt::math::TPose2D nomad_from_robot(x * kTenthInch_m, y * kTenthInch_m, nomadFromRobot().phi);
  nomad_from_odom_ = portable::compose(nomad_from_robot, portable::inverse(robot_.odometry().odom_from_robot));
  return 1;
}

int ScoutRobot::da(int steer, int) {
  const mrpt::math::TPose2D now = nomadFromRobot();
  const mrpt::math::TPose2D nomad_from_robot(now.x, now.y, steer * kTenthDeg_rad);
  nomad_from_odom_ = portable::compose(nomad_from_robot, portable::inverse(robot_.odometry().odom_from_robot));
  return 1;
}

int ScoutRobot::gs() {
  if (clock_ && state_step_ == robot_.stepNumber()) wait("gs");
  drive_.update();
  get_sn();
  const Odometry& odometry = robot_.odometry();
  const mrpt::math::TPose2D pose = nomadFromRobot();
  State[STATE_CONF_X] = toTenthInches(pose.x);
  State[STATE_CONF_Y] = toTenthInches(pose.y);
  State[STATE_CONF_STEER] = State[STATE_CONF_TURRET] = toTenthDegrees(pose.phi);
  State[STATE_VEL_RIGHT] = toTenthInches(odometry.speed_mps + odometry.turn_radps * kHalfTrack_m);
  State[STATE_VEL_LEFT] = toTenthInches(odometry.speed_mps - odometry.turn_radps * kHalfTrack_m);
  State[STATE_MOTOR_STATUS] = odometry.speed_mps != 0 || odometry.turn_radps != 0;
  State[STATE_COMPASS] = toTenthDegrees(robot_.compass().value_or(0));
  State[STATE_ERROR] = robot_.stalled();
  State[STATE_BUMPER] = 0;
  const std::size_t bits = std::min<std::size_t>(62, robot_.bumper().size());  // the value bits of a long
  for (std::size_t i = 0; i < bits; ++i) State[STATE_BUMPER] |= long{robot_.bumper()[i]} << i;
  for (std::size_t i = 0; i < std::min<std::size_t>(16, robot_.infrared().size()); ++i) {
    State[STATE_IR_0 + i] = toTenthInches(robot_.infrared()[i].range_m);
  }
  state_step_ = robot_.stepNumber();
  return 1;
}

int ScoutRobot::get_sn() {
  for (std::size_t i = 0; i < std::min(sonar_on_.size(), robot_.sonar().size()); ++i) {
    if (sonar_on_[i]) State[STATE_SONAR_0 + i] = toTenthInches(robot_.sonar()[i].range_m);
  }
  return 1;
}

int ScoutRobot::conf_sn(int, std::span<const int> order) {
  sonar_on_.fill(false);
  for (const int sonar : order) {
    if (sonar < 0 || sonar >= static_cast<int>(sonar_on_.size())) break;
    sonar_on_[static_cast<std::size_t>(sonar)] = true;
  }
  return 1;
}

mrpt::math::TPose2D ScoutRobot::nomadFromRobot() const {
  return portable::compose(nomad_from_odom_, robot_.odometry().odom_from_robot);
}

void ScoutRobot::wait(const char* function) {
  if (!clock_) {
    throw std::logic_error(
        std::string("ScoutRobot::") + function +
        ": created without a clock; it waits only in a BlockingController's program, created with the "
        "clock that the program receives");
  }
  clock_->waitForNextStep();
  drive_.update();
}

}  // namespace robosim
