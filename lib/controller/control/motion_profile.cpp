#include "control/motion_profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <mrpt/math/wrap2pi.h>

#include "base/portable_math.h"

namespace robosim {
namespace {

double clipped(double desired, double hardware) { return desired > 0 ? std::min(desired, hardware) : hardware; }

AxisLimits clipped(const AxisLimits& desired, const AxisLimits& hardware) {
  return {clipped(desired.speed_max, hardware.speed_max), clipped(desired.accel, hardware.accel),
          clipped(desired.decel, hardware.decel)};
}

AxisLimits hardwareWay(const Robot& robot) {
  const MotionLimits& limits = robot.info().type->limits;
  return {limits.speed_max_mps, limits.accel_mps2, limits.decel_mps2};
}

AxisLimits hardwareTurn(const Robot& robot) {
  const MotionLimits& limits = robot.info().type->limits;
  return {limits.turn_max_radps, limits.turn_accel_radps2, limits.turn_accel_radps2};
}

}  // namespace

double speedTowards(double desired, double speed, const AxisLimits& limits, double period_s) {
  desired = std::clamp(desired, -limits.speed_max, limits.speed_max);
  if (speed * desired < 0) desired = 0;  // to rest before reversing
  const double change = (std::abs(desired) > std::abs(speed) ? limits.accel : limits.decel) * period_s;
  return std::clamp(desired, speed - change, speed + change);
}

double speedToStopAfter(double to_go, double decel, double period_s) {
  // Decelerating from v by decel·period per period, it stops after n periods and a distance of n·v·period -
  // decel·period²·n(n-1)/2. Computes the smallest n for which this can equal the distance, then v.
  const double distance = std::abs(to_go), loss = decel * period_s;
  const double periods = std::max(1.0, std::ceil((std::sqrt(1 + 8 * distance / (loss * period_s)) - 1) / 2));
  return std::copysign(distance / (periods * period_s) + loss * (periods - 1) / 2, to_go);
}

void ProfiledDrive::Axis::keep(double new_speed) {
  to_target = false;
  speed = new_speed;
}

void ProfiledDrive::Axis::go(double distance) {
  to_target = true;
  target = covered + distance;
}

double ProfiledDrive::Axis::next(double speed_now, double period_s) const {
  const double desired = to_target ? speedToStopAfter(toGo(), limits.decel, period_s) : speed;
  return speedTowards(desired, speed_now, limits, period_s);
}

ProfiledDrive::ProfiledDrive(Robot& robot) : robot_(robot) {
  if (!robot.sensor(SensorKind::odometry)) {
    throw std::invalid_argument("robot '" + robot.name() +
                                "' has no odometry, by which moves are measured; add <odometry/> to its model");
  }
  way_.limits = hardwareWay(robot);
  turn_.limits = hardwareTurn(robot);
  last_odom_from_robot_ = robot.odometry().odom_from_robot;
}

void ProfiledDrive::setSpeed(double speed_mps) {
  way_.keep(speed_mps);
  command();
}

void ProfiledDrive::moveBy(double way_m) {
  way_.go(way_m);
  command();
}

void ProfiledDrive::setTurn(double turn_radps) {
  turn_.keep(turn_radps);
  command();
}

void ProfiledDrive::setLateral(double lateral_mps) {
  if (robot_.info().type->drive.kind == DriveKind::omni) lateral_mps_ = lateral_mps;
  command();
}

void ProfiledDrive::turnBy(double angle_rad) {
  turn_.go(angle_rad);
  command();
}

void ProfiledDrive::turnTo(double odom_rad) { turnBy(mrpt::math::wrapToPi(odom_rad - last_odom_from_robot_.phi)); }

void ProfiledDrive::stop() {
  way_.keep(0);
  turn_.keep(0);
  lateral_mps_ = 0;
  command();
}

void ProfiledDrive::enable(bool on) {
  enabled_ = on;
  command();
}

void ProfiledDrive::limitWay(const AxisLimits& limits) { way_.limits = clipped(limits, hardwareWay(robot_)); }

void ProfiledDrive::limitTurn(const AxisLimits& limits) { turn_.limits = clipped(limits, hardwareTurn(robot_)); }

void ProfiledDrive::update() {
  const auto& now = robot_.odometry().odom_from_robot;
  const double turned = mrpt::math::wrapToPi(now.phi - last_odom_from_robot_.phi);
  const double middle = last_odom_from_robot_.phi + turned / 2;  // an arc's chord points midway between its headings
  const auto [sin, cos] = portable::sincos(middle);
  way_.covered += (now.x - last_odom_from_robot_.x) * cos + (now.y - last_odom_from_robot_.y) * sin;
  turn_.covered += turned;
  last_odom_from_robot_ = now;
  command();
}

void ProfiledDrive::command() {
  if (!enabled_) {
    robot_.stop();
    return;
  }
  const Odometry& odometry = robot_.odometry();
  const double period_s = robot_.readings().time.period_s;
  robot_.drive(way_.next(odometry.speed_mps, period_s), turn_.next(odometry.turn_radps, period_s), lateral_mps_);
}

}  // namespace robosim
