#include "aria/pioneer_sensors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include <mrpt/math/wrap2pi.h>

#include "aria/pioneer_units.h"
#include "base/angle_units.h"
#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "control/echo.h"

namespace robosim {
namespace {

constexpr std::size_t kMaxBumperBits = 7;  // of each byte of the stall value

int toMm(double range_m) { return Math::roundInt(range_m * kMmPerM); }

PioneerPose inAriaUnits(const mrpt::math::TPose2D& pose) {
  return {pose.x * kMmPerM, pose.y * kMmPerM, mrpt::math::wrapToPi(pose.phi) * kDegPerRad};
}

}  // namespace

PioneerPose PioneerSensors::getPose() const {
  return inAriaUnits(portable::compose(aria_from_odom_, robot_.odometry().odom_from_robot));
}

PioneerPose PioneerSensors::getEncoderPose() const { return inAriaUnits(robot_.odometry().odom_from_robot); }

PioneerTransform PioneerSensors::getEncoderTransform() const { return PioneerTransform(inAriaUnits(aria_from_odom_)); }

void PioneerSensors::setPose(const PioneerPose& pose) {
  const mrpt::math::TPose2D aria_from_robot(pose.x / kMmPerM, pose.y / kMmPerM, pose.th / kDegPerRad);
  aria_from_odom_ = portable::compose(aria_from_robot, portable::inverse(robot_.odometry().odom_from_robot));
}

double PioneerSensors::getVel() const { return robot_.odometry().speed_mps * kMmPerM; }
double PioneerSensors::getRotVel() const { return robot_.odometry().turn_radps * kDegPerRad; }
double PioneerSensors::getLatVel() const { return robot_.odometry().lateral_mps * kMmPerM; }
double PioneerSensors::getLeftVel() const { return getVel() - robot_.odometry().turn_radps * kHalfTrack_mm; }
double PioneerSensors::getRightVel() const { return getVel() + robot_.odometry().turn_radps * kHalfTrack_mm; }
double PioneerSensors::getRobotRadius() const { return robot_.info().radius_m * kMmPerM; }

double PioneerSensors::getCompass() const {
  const double deg = robot_.compass().value_or(0) * kDegPerRad;
  return deg < 0 ? deg + 360 : deg;
}

std::vector<PioneerSensors::Bumper> PioneerSensors::bumpers(bool front) const {
  const SensorInfo* sensor = robot_.sensor(SensorKind::bumper);
  if (!sensor) return {};
  std::vector<Bumper> found;
  for (std::size_t i = 0; i < sensor->beams.size(); ++i) {
    const double deg = Math::fixAngle(sensor->beams[i].robot_from_beam.yaw * kDegPerRad);
    if ((std::abs(deg) <= 90) == front) found.push_back({deg, robot_.bumper()[i] != 0});
  }
  // Clockwise: in front by decreasing direction; behind, 180 to 360 is on the right.
  const auto place = [front](const Bumper& bumper) {
    return front || bumper.direction > 0 ? bumper.direction : bumper.direction + 360;
  };
  std::stable_sort(found.begin(), found.end(), [&](const Bumper& a, const Bumper& b) { return place(a) > place(b); });
  return found;
}

int PioneerSensors::getStallValue() const {
  const auto bits_of = [this](bool front) {
    const auto segments = bumpers(front);
    int bits = 0;
    for (std::size_t i = 0; i < std::min(segments.size(), kMaxBumperBits); ++i) {
      bits |= segments[i].pressed ? 2 << i : 0;
    }
    return bits;
  };
  return (isLeftMotorStalled() ? 1 : 0) | bits_of(false) | ((isRightMotorStalled() ? 1 : 0) | bits_of(true)) << 8;
}

std::optional<double> PioneerSensors::getBumpDirection(bool front) const {
  double sum = 0;
  int pressed = 0;
  for (const Bumper& bumper : bumpers(front)) {
    if (!bumper.pressed) continue;
    sum += front ? bumper.direction : Math::subAngle(bumper.direction, 180);
    ++pressed;
  }
  if (pressed == 0) return std::nullopt;
  return front ? sum / pressed : Math::addAngle(sum / pressed, 180);
}

void PioneerSensors::acquireSensorReadings(unsigned sensors) {
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

bool PioneerSensors::isNew(SensorKind kind, unsigned sensor) const {
  if (!robot_.sensor(kind)) return false;
  const auto& requested = requested_in_step_[static_cast<std::size_t>(std::countr_zero(sensor))];
  return !requested || robot_.stepNumber() > *requested;
}

const Echo* PioneerSensors::echoOf(SensorKind kind, int number) const {
  const Echoes& echoes = robot_.echoes(kind);
  if (number < 0 || static_cast<std::size_t>(number) >= echoes.size()) return nullptr;
  return &echoes[static_cast<std::size_t>(number)];
}

int PioneerSensors::getSonarRange(int number) const {
  const Echo* echo = echoOf(SensorKind::sonar, number);
  if (!echo) return -1;
  return toMm(sonar_on_ ? echo->range_m : robot_.sensor(SensorKind::sonar)->no_echo_m);
}

bool PioneerSensors::hasSonarEcho(int number) const {
  const Echo* echo = echoOf(SensorKind::sonar, number);
  return echo && sonar_on_ && isEcho(*robot_.sensor(SensorKind::sonar), *echo);
}

SensorReading PioneerSensors::readingOf(SensorKind kind, int number, int range, bool on) const {
  const Echo& echo = *echoOf(kind, number);
  const auto& mount = robot_.sensor(kind)->beams[static_cast<std::size_t>(number)].robot_from_beam;
  mrpt::math::TPoint2D local(echo.point_m.x, echo.point_m.y);
  if (!on) {
    const auto [sin, cos] = portable::sincos(mount.yaw);
    local = {mount.x + range / kMmPerM * cos, mount.y + range / kMmPerM * sin};
  }
  const mrpt::math::TPoint2D point =
      portable::compose(portable::compose(aria_from_odom_, robot_.odometry().odom_from_robot), local);
  return {.range = range,
          .x = point.x * kMmPerM,
          .y = point.y * kMmPerM,
          .local_x = local.x * kMmPerM,
          .local_y = local.y * kMmPerM,
          .sensor_x = mount.x * kMmPerM,
          .sensor_y = mount.y * kMmPerM,
          .sensor_th = mount.yaw * kDegPerRad};
}

std::optional<SensorReading> PioneerSensors::getSonarReading(int number) const {
  if (!echoOf(SensorKind::sonar, number)) return std::nullopt;
  return readingOf(SensorKind::sonar, number, getSonarRange(number), sonar_on_);
}

int PioneerSensors::getClosestSonarNumber(double from_deg, double to_deg) const {
  int closest = -1;
  for (int i = 0; i < getNumSonar(); ++i) {
    const auto& mount = robot_.sensor(SensorKind::sonar)->beams[static_cast<std::size_t>(i)].robot_from_beam;
    if (!Math::angleBetween(mount.yaw * kDegPerRad, from_deg, to_deg)) continue;
    if (closest < 0 || getSonarRange(i) < getSonarRange(closest)) closest = i;
  }
  return closest;
}

int PioneerSensors::getClosestSonarRange(double from_deg, double to_deg) const {
  return getSonarRange(getClosestSonarNumber(from_deg, to_deg));
}

int PioneerSensors::getLaserRange(int number) const {
  const Echo* echo = echoOf(SensorKind::laser, number);
  return echo ? toMm(echo->range_m) : -1;
}

bool PioneerSensors::hasLaserEcho(int number) const {
  const Echo* echo = echoOf(SensorKind::laser, number);
  return echo && isEcho(*robot_.sensor(SensorKind::laser), *echo);
}

std::optional<SensorReading> PioneerSensors::getLaserReading(int number) const {
  if (!echoOf(SensorKind::laser, number)) return std::nullopt;
  return readingOf(SensorKind::laser, number, getLaserRange(number), true);
}

void PioneerSensors::turnLaser(double deg) { robot_.panLaser(deg / kDegPerRad); }

std::optional<ClosestPoint> PioneerSensors::nearestEcho(const std::function<bool(double x, double y)>& accept) const {
  std::optional<ClosestPoint> nearest;
  const auto look = [&](SensorKind kind) {
    for (const Echo& echo : robot_.echoes(kind)) {
      if (!isEcho(*robot_.sensor(kind), echo)) continue;
      const double x = echo.point_m.x * kMmPerM, y = echo.point_m.y * kMmPerM;
      const double distance = portable::hypot(x, y);
      if ((nearest && distance >= nearest->distance) || !accept(x, y)) continue;
      nearest = {.distance = distance, .angle = Math::atan2(y, x), .local = {x, y, 0}};
    }
  };
  if (sonar_on_) look(SensorKind::sonar);
  look(SensorKind::laser);
  return nearest;
}

}  // namespace robosim
