#include "control/pioneer_robot.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <mrpt/math/wrap2pi.h>

#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "control/echo.h"

namespace robosim {
namespace {

constexpr double kMmPerM = 1000;
constexpr double kDegPerRad = 180 / std::numbers::pi;
/// Half the track [mm] that ARIA assumes for a Pioneer 3-DX: 1 / its DiffConvFactor of 0.0056.
constexpr double kHalfTrack_mm = 178.6;
constexpr double kMoveDone_mm = 40;
constexpr double kHeadingDone_deg = 3;

int toMm(double range_m) { return static_cast<int>(std::lround(range_m * kMmPerM)); }

}  // namespace

PioneerRobot::PioneerRobot(Robot& robot) : robot_(robot), drive_(robot) {}

PioneerRobot::PioneerRobot(Robot& robot, StepClock& clock) : robot_(robot), clock_(&clock), drive_(robot) {}

void PioneerRobot::update() {
  drive_.update();
  if (!direct_motion_ && !actions_.empty()) obey(actions_.resolve(*this));
}

void PioneerRobot::waitForNextStep() {
  if (!clock_) {
    throw std::logic_error(
        "PioneerRobot::waitForNextStep: made without a clock; in a BlockingController's program make it with the clock "
        "that the program is given, in a Controller call update() once a step instead");
  }
  clock_->waitForNextStep();
  update();
}

void PioneerRobot::run() {
  while (running_ && isConnected()) waitForNextStep();
}

void PioneerRobot::disconnect() {
  robot_.halt();
  running_ = false;
}

void PioneerRobot::setVel(double mm_ps) {
  direct_motion_ = true;
  drive_.setSpeed(mm_ps / kMmPerM);
}

void PioneerRobot::setVel2(double left_mm_ps, double right_mm_ps) {
  direct_motion_ = true;
  drive_.setSpeed((left_mm_ps + right_mm_ps) / 2 / kMmPerM);
  drive_.setTurn((right_mm_ps - left_mm_ps) / 2 / kHalfTrack_mm);
}

void PioneerRobot::setRotVel(double deg_ps) {
  direct_motion_ = true;
  drive_.setTurn(deg_ps / kDegPerRad);
}

void PioneerRobot::setHeading(double deg) {
  direct_motion_ = true;
  drive_.turnTo(deg / kDegPerRad - aria_from_odom_.phi);
}

void PioneerRobot::setDeltaHeading(double deg) {
  direct_motion_ = true;
  drive_.turnBy(deg / kDegPerRad);
}

void PioneerRobot::move(double mm) {
  direct_motion_ = true;
  drive_.moveBy(mm / kMmPerM);
}

void PioneerRobot::stop() {
  direct_motion_ = true;
  drive_.stop();
}

bool PioneerRobot::isMoveDone(double delta_mm) const {
  return std::abs(drive_.wayToGo()) * kMmPerM <= (delta_mm > 0 ? delta_mm : kMoveDone_mm);
}

bool PioneerRobot::isHeadingDone(double delta_deg) const {
  return std::abs(drive_.turnToGo()) * kDegPerRad <= (delta_deg > 0 ? delta_deg : kHeadingDone_deg);
}

void PioneerRobot::clearDirectMotion() {
  drive_.stop();
  direct_motion_ = false;
}

bool PioneerRobot::limitWay(double AxisLimits::*limit, double value) {
  if (!(value > 0)) return false;
  AxisLimits limits = drive_.wayLimits();
  limits.*limit = value / kMmPerM;
  drive_.limitWay(limits);
  return true;
}

bool PioneerRobot::limitTurn(double AxisLimits::*limit, double value) {
  if (!(value > 0)) return false;
  AxisLimits limits = drive_.turnLimits();
  limits.*limit = value / kDegPerRad;
  drive_.limitTurn(limits);
  return true;
}

bool PioneerRobot::setTransVelMax(double mm_ps) { return limitWay(&AxisLimits::speed_max, mm_ps); }
bool PioneerRobot::setTransAccel(double mm_ps2) { return limitWay(&AxisLimits::accel, mm_ps2); }
bool PioneerRobot::setTransDecel(double mm_ps2) { return limitWay(&AxisLimits::decel, mm_ps2); }
bool PioneerRobot::setRotVelMax(double deg_ps) { return limitTurn(&AxisLimits::speed_max, deg_ps); }
bool PioneerRobot::setRotAccel(double deg_ps2) { return limitTurn(&AxisLimits::accel, deg_ps2); }
bool PioneerRobot::setRotDecel(double deg_ps2) { return limitTurn(&AxisLimits::decel, deg_ps2); }
double PioneerRobot::getTransVelMax() const { return drive_.wayLimits().speed_max * kMmPerM; }
double PioneerRobot::getTransAccel() const { return drive_.wayLimits().accel * kMmPerM; }
double PioneerRobot::getTransDecel() const { return drive_.wayLimits().decel * kMmPerM; }
double PioneerRobot::getRotVelMax() const { return drive_.turnLimits().speed_max * kDegPerRad; }
double PioneerRobot::getRotAccel() const { return drive_.turnLimits().accel * kDegPerRad; }
double PioneerRobot::getRotDecel() const { return drive_.turnLimits().decel * kDegPerRad; }

PioneerPose PioneerRobot::getPose() const {
  const mrpt::math::TPose2D pose = portable::compose(aria_from_odom_, robot_.odometry().odom_from_robot);
  return {pose.x * kMmPerM, pose.y * kMmPerM, mrpt::math::wrapToPi(pose.phi) * kDegPerRad};
}

void PioneerRobot::moveTo(const PioneerPose& pose) {
  const mrpt::math::TPose2D aria_from_robot(pose.x / kMmPerM, pose.y / kMmPerM, pose.th / kDegPerRad);
  aria_from_odom_ = portable::compose(aria_from_robot, portable::inverse(robot_.odometry().odom_from_robot));
}

double PioneerRobot::getVel() const { return robot_.odometry().speed_mps * kMmPerM; }
double PioneerRobot::getRotVel() const { return robot_.odometry().turn_radps * kDegPerRad; }
double PioneerRobot::getLeftVel() const { return getVel() - robot_.odometry().turn_radps * kHalfTrack_mm; }
double PioneerRobot::getRightVel() const { return getVel() + robot_.odometry().turn_radps * kHalfTrack_mm; }
double PioneerRobot::getRobotRadius() const { return robot_.info().radius_m * kMmPerM; }

void PioneerRobot::acquireSensorReadings(unsigned sensors) {
  for (const auto& [sensor, kind] :
       {std::pair{SONAR, SensorKind::sonar}, std::pair{LASER, SensorKind::laser}, std::pair{HEAT, SensorKind::heat}}) {
    if (!(sensors & sensor)) continue;
    if (!robot_.sensor(kind)) {
      throw std::invalid_argument("acquireSensorReadings: robot '" + robot_.name() + "' has no " + nameOf(kind) +
                                  "; give its model one, or do not ask for it");
    }
    requested_in_step_[static_cast<std::size_t>(std::countr_zero(sensor))] = robot_.stepNumber();
  }
}

bool PioneerRobot::isNew(SensorKind kind, unsigned sensor) const {
  if (!robot_.sensor(kind)) return false;
  const auto& requested = requested_in_step_[static_cast<std::size_t>(std::countr_zero(sensor))];
  return !requested || robot_.stepNumber() > *requested;
}

int PioneerRobot::getSonarRange(int number) const {
  if (number < 0 || number >= getNumSonar()) return -1;
  if (!sonar_on_) return toMm(robot_.sensor(SensorKind::sonar)->no_echo_m);
  return toMm(robot_.sonar()[static_cast<std::size_t>(number)].range_m);
}

std::optional<PioneerSonarReading> PioneerRobot::getSonarReading(int number) const {
  if (number < 0 || number >= getNumSonar()) return std::nullopt;
  const auto i = static_cast<std::size_t>(number);
  const auto& mount = robot_.sensor(SensorKind::sonar)->beams[i].robot_from_beam;
  const int range = getSonarRange(number);
  mrpt::math::TPoint2D local(robot_.sonar()[i].point_m.x, robot_.sonar()[i].point_m.y);
  if (!sonar_on_) {
    const auto [sin, cos] = portable::sincos(mount.yaw);
    local = {mount.x + range / kMmPerM * cos, mount.y + range / kMmPerM * sin};
  }
  const mrpt::math::TPoint2D point =
      portable::compose(portable::compose(aria_from_odom_, robot_.odometry().odom_from_robot), local);
  return PioneerSonarReading{.range = range,
                             .x = point.x * kMmPerM,
                             .y = point.y * kMmPerM,
                             .local_x = local.x * kMmPerM,
                             .local_y = local.y * kMmPerM,
                             .sensor_x = mount.x * kMmPerM,
                             .sensor_y = mount.y * kMmPerM,
                             .sensor_th = mount.yaw * kDegPerRad};
}

int PioneerRobot::getClosestSonarNumber(double from_deg, double to_deg) const {
  int closest = -1;
  for (int i = 0; i < getNumSonar(); ++i) {
    const auto& mount = robot_.sensor(SensorKind::sonar)->beams[static_cast<std::size_t>(i)].robot_from_beam;
    if (!Math::angleBetween(mount.yaw * kDegPerRad, from_deg, to_deg)) continue;
    if (closest < 0 || getSonarRange(i) < getSonarRange(closest)) closest = i;
  }
  return closest;
}

int PioneerRobot::getClosestSonarRange(double from_deg, double to_deg) const {
  return getSonarRange(getClosestSonarNumber(from_deg, to_deg));
}

int PioneerRobot::getLaserRange(int number) const {
  if (number < 0 || number >= getNumLaser()) return -1;
  return toMm(robot_.laser()[static_cast<std::size_t>(number)].range_m);
}

void PioneerRobot::turnLaser(double deg) { robot_.panLaser(deg / kDegPerRad); }

template <typename Accept>
double PioneerRobot::nearestEcho(const Accept& accept, double if_none) const {
  double nearest = if_none;
  const auto look = [&](SensorKind kind) {
    for (const Echo& echo : robot_.echoes(kind)) {
      if (!isEcho(*robot_.sensor(kind), echo)) continue;
      const double x = echo.point_m.x * kMmPerM, y = echo.point_m.y * kMmPerM;
      const double distance = portable::hypot(x, y);
      if (distance < nearest && accept(x, y)) nearest = distance;
    }
  };
  if (sonar_on_) look(SensorKind::sonar);
  look(SensorKind::laser);
  return nearest;
}

double PioneerRobot::checkRangeDevicesCurrentPolar(double from_deg, double to_deg, double if_none) const {
  return nearestEcho(
      [&](double x, double y) { return Math::angleBetween(portable::atan2(y, x) * kDegPerRad, from_deg, to_deg); },
      if_none);
}

double PioneerRobot::checkRangeDevicesCurrentBox(double x1, double y1, double x2, double y2, double if_none) const {
  return nearestEcho(
      [&](double x, double y) {
        return std::min(x1, x2) <= x && x <= std::max(x1, x2) && std::min(y1, y2) <= y && y <= std::max(y1, y2);
      },
      if_none);
}

void PioneerRobot::obey(const ActionDesired& desired) {
  const double velocity = desired.getVelStrength() > 0 ? desired.getVel() : 0;
  drive_.setSpeed(std::clamp(velocity, desired.getMaxNegVel(), desired.getMaxVel()) / kMmPerM);
  if (desired.getDeltaHeadingStrength() > 0) {
    drive_.turnBy(desired.getDeltaHeading() / kDegPerRad);
  } else {
    drive_.setTurn(desired.getRotVelStrength() > 0 ? desired.getRotVel() / kDegPerRad : 0);
  }
}

}  // namespace robosim
