// Motion of a PioneerRobot: direct motion, limits, and the desired motion of its actions.
#include <algorithm>
#include <cmath>

#include "aria/pioneer_robot.h"
#include "aria/pioneer_units.h"
#include "base/angle_units.h"

namespace robosim {

void PioneerRobot::switchMotors(bool on) {
  drive_.enable(on);
  robot_.enableMotors(on);
}

void PioneerRobot::switchSonar(bool on) {
  sonar_on_ = on;
  robot_.enableSonar(on);
}

void PioneerRobot::beginDirectMotion() {
  direct_since_s_ = time();
  drive_.limitWay(way_limits_);
  drive_.limitTurn(turn_limits_);
}

void PioneerRobot::setVel(double mm_ps) {
  beginDirectMotion();
  drive_.setSpeed(mm_ps / kMmPerM);
}

void PioneerRobot::setVel2(double left_mm_ps, double right_mm_ps) {
  beginDirectMotion();
  drive_.setSpeed((left_mm_ps + right_mm_ps) / 2 / kMmPerM);
  drive_.setTurn((right_mm_ps - left_mm_ps) / 2 / kHalfTrack_mm);
}

void PioneerRobot::setRotVel(double deg_ps) {
  beginDirectMotion();
  drive_.setTurn(deg_ps / kDegPerRad);
}

void PioneerRobot::setLatVel(double mm_ps) {
  beginDirectMotion();
  drive_.setLateral(mm_ps / kMmPerM);
}

void PioneerRobot::setHeading(double deg) {
  beginDirectMotion();
  drive_.turnTo(deg / kDegPerRad - aria_from_odom_.phi);
}

void PioneerRobot::setDeltaHeading(double deg) {
  beginDirectMotion();
  drive_.turnBy(deg / kDegPerRad);
}

void PioneerRobot::move(double mm) {
  beginDirectMotion();
  drive_.moveBy(mm / kMmPerM);
}

void PioneerRobot::stop() {
  beginDirectMotion();
  drive_.stop();
}

bool PioneerRobot::isMoveDone(double delta_mm) const {
  return std::abs(drive_.wayToGo()) * kMmPerM <= (delta_mm > 0 ? delta_mm : move_done_mm_);
}

bool PioneerRobot::isHeadingDone(double delta_deg) const {
  return std::abs(drive_.turnToGo()) * kDegPerRad <= (delta_deg > 0 ? delta_deg : heading_done_deg_);
}

void PioneerRobot::clearDirectMotion() {
  drive_.stop();
  direct_since_s_.reset();
}

bool PioneerRobot::limitWay(double AxisLimits::*limit, double value) {
  if (!(value > 0)) return false;
  way_limits_.*limit = value / kMmPerM;
  drive_.limitWay(way_limits_);
  way_limits_ = drive_.wayLimits();
  return true;
}

bool PioneerRobot::limitTurn(double AxisLimits::*limit, double value) {
  if (!(value > 0)) return false;
  turn_limits_.*limit = value / kDegPerRad;
  drive_.limitTurn(turn_limits_);
  turn_limits_ = drive_.turnLimits();
  return true;
}

bool PioneerRobot::setTransVelMax(double mm_ps) { return limitWay(&AxisLimits::speed_max, mm_ps); }
bool PioneerRobot::setTransAccel(double mm_ps2) { return limitWay(&AxisLimits::accel, mm_ps2); }
bool PioneerRobot::setTransDecel(double mm_ps2) { return limitWay(&AxisLimits::decel, mm_ps2); }
bool PioneerRobot::setRotVelMax(double deg_ps) { return limitTurn(&AxisLimits::speed_max, deg_ps); }
bool PioneerRobot::setRotAccel(double deg_ps2) { return limitTurn(&AxisLimits::accel, deg_ps2); }
bool PioneerRobot::setRotDecel(double deg_ps2) { return limitTurn(&AxisLimits::decel, deg_ps2); }
double PioneerRobot::getTransVelMax() const { return way_limits_.speed_max * kMmPerM; }
double PioneerRobot::getTransAccel() const { return way_limits_.accel * kMmPerM; }
double PioneerRobot::getTransDecel() const { return way_limits_.decel * kMmPerM; }
double PioneerRobot::getRotVelMax() const { return turn_limits_.speed_max * kDegPerRad; }
double PioneerRobot::getRotAccel() const { return turn_limits_.accel * kDegPerRad; }
double PioneerRobot::getRotDecel() const { return turn_limits_.decel * kDegPerRad; }
double PioneerRobot::getAbsoluteMaxTransVel() const { return robot_.info().type->limits.speed_max_mps * kMmPerM; }
double PioneerRobot::getAbsoluteMaxRotVel() const { return robot_.info().type->limits.turn_max_radps * kDegPerRad; }
double PioneerRobot::getAbsoluteMaxLatVel() const { return robot_.info().type->limits.lateral_max_mps * kMmPerM; }

void PioneerRobot::obey(const ActionDesired& desired) {
  AxisLimits way = way_limits_, turn = turn_limits_;
  way.accel = desired.getTransAccel().value_or(way.accel * kMmPerM) / kMmPerM;
  way.decel = desired.getTransDecel().value_or(way.decel * kMmPerM) / kMmPerM;
  turn.accel = desired.getRotAccel().value_or(turn.accel * kDegPerRad) / kDegPerRad;
  turn.decel = desired.getRotDecel().value_or(turn.decel * kDegPerRad) / kDegPerRad;
  const double turn_max = std::min(turn.speed_max, desired.getMaxRotVel() / kDegPerRad);
  if (turn_max > 0) turn.speed_max = turn_max;
  drive_.limitWay(way);
  drive_.limitTurn(turn);

  const double velocity = desired.getVelStrength() > 0 ? desired.getVel() : 0;
  drive_.setSpeed(std::clamp(velocity, desired.getMaxNegVel(), desired.getMaxVel()) / kMmPerM);
  if (turn_max == 0) {
    drive_.setTurn(0);
  } else if (desired.getDeltaHeadingStrength() > 0) {
    drive_.turnBy(desired.getDeltaHeading() / kDegPerRad);
  } else {
    drive_.setTurn(desired.getRotVelStrength() > 0 ? desired.getRotVel() / kDegPerRad : 0);
  }
}

}  // namespace robosim
