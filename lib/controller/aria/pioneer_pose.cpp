#include "aria/pioneer_pose.h"

#include <cmath>

#include "aria/pioneer_units.h"
#include "base/angle_units.h"
#include "base/portable_math.h"

namespace robosim {

double Math::fixAngle(double deg) {
  if (-180 < deg && deg <= 180) return deg;
  const double fixed = std::remainder(deg, 360);  // exact
  return fixed == -180 ? 180 : fixed;
}

double Math::degToRad(double deg) { return deg / kDegPerRad; }
double Math::radToDeg(double rad) { return rad * kDegPerRad; }
double Math::sin(double deg) { return portable::sin(degToRad(deg)); }
double Math::cos(double deg) { return portable::cos(degToRad(deg)); }
double Math::atan2(double y, double x) { return radToDeg(portable::atan2(y, x)); }

double Math::distanceBetween(double x1, double y1, double x2, double y2) { return portable::hypot(x2 - x1, y2 - y1); }

bool Math::angleBetween(double deg, double from_deg, double to_deg) {
  const auto upwards = [from_deg](double angle) {
    const double rest = std::fmod(angle - from_deg, 360);
    return rest < 0 ? rest + 360 : rest;
  };
  if (to_deg - from_deg >= 360) return true;
  return upwards(deg) <= upwards(to_deg);
}

int Math::roundInt(double value) { return static_cast<int>(std::lround(value)); }

std::pair<double, double> Math::pointRotate(double x, double y, double deg) {
  const auto [sin, cos] = portable::sincos(degToRad(deg));
  return {x * cos - y * sin, x * sin + y * cos};
}

double PioneerPose::findDistanceTo(const PioneerPose& other) const {
  return Math::distanceBetween(x, y, other.x, other.y);
}

double PioneerPose::squaredFindDistanceTo(const PioneerPose& other) const {
  return (other.x - x) * (other.x - x) + (other.y - y) * (other.y - y);
}

double PioneerPose::findAngleTo(const PioneerPose& other) const { return Math::atan2(other.y - y, other.x - x); }

PioneerPose operator+(const PioneerPose& a, const PioneerPose& b) {
  return {a.x + b.x, a.y + b.y, Math::addAngle(a.th, b.th)};
}

PioneerPose operator-(const PioneerPose& a, const PioneerPose& b) {
  return {a.x - b.x, a.y - b.y, Math::subAngle(a.th, b.th)};
}

void PioneerTransform::setTransform(const PioneerPose& pose) { origin_ = pose; }

void PioneerTransform::setTransform(const PioneerPose& from, const PioneerPose& to) {
  const double turn = Math::subAngle(to.th, from.th);
  const auto [x, y] = Math::pointRotate(from.x, from.y, turn);
  origin_ = {to.x - x, to.y - y, turn};
}

PioneerPose PioneerTransform::doTransform(const PioneerPose& source) const {
  const auto [x, y] = Math::pointRotate(source.x, source.y, origin_.th);
  return {origin_.x + x, origin_.y + y, Math::addAngle(source.th, origin_.th)};
}

PioneerPose PioneerTransform::doInvTransform(const PioneerPose& source) const {
  const auto [x, y] = Math::pointRotate(source.x - origin_.x, source.y - origin_.y, -origin_.th);
  return {x, y, Math::subAngle(source.th, origin_.th)};
}

}  // namespace robosim
