#include "aria/laser_device.h"

#include <cmath>

#include "aria/pioneer_robot.h"

namespace robosim {
namespace {

constexpr double kLaserMaxRange_mm = 32000;

/// Whether a beam from `from` to `to` passes a point: nearer than `clearance`, and farther than that before its end.
bool passes(const PioneerPose& from, const PioneerPose& to, const RangePoint& point, double clearance) {
  const double length = from.findDistanceTo(to);
  if (length == 0) return false;
  const double along_x = (to.x - from.x) / length, along_y = (to.y - from.y) / length;
  const double x = point.x - from.x, y = point.y - from.y;
  const double along = x * along_x + y * along_y, across = y * along_x - x * along_y;
  return 0 < along && along < length - clearance && std::abs(across) < clearance;
}

}  // namespace

LaserDevice::LaserDevice(std::size_t current_size, std::size_t cumulative_size, std::string name)
    : RangeDevice(current_size, cumulative_size, std::move(name), kLaserMaxRange_mm) {
  setMaxSecondsToKeepCumulative(30);
  setMaxDistToKeepCumulative(4000);
}

void LaserDevice::processReadings(PioneerRobot& robot) {
  raw_.clear();
  for (int i = 0; i < robot.getNumLaser(); ++i) raw_.push_back(*robot.getLaserReading(i));
  addCurrent(robot);
  clean(robot);
  addCumulative(robot.getPose());
}

void LaserDevice::addCurrent(const PioneerRobot& robot) {
  current().clear();
  for (int i = 0; i < robot.getNumLaser(); ++i) {
    const RangePoint point{raw_[static_cast<std::size_t>(i)].x, raw_[static_cast<std::size_t>(i)].y, now()};
    if (!robot.hasLaserEcho(i)) continue;
    if (gap_current_ > 0 && !getCurrentBuffer().empty()) {
      const RangePoint& last = getCurrentBuffer().front();
      if (Math::distanceBetween(last.x, last.y, point.x, point.y) < gap_current_) continue;
    }
    current().addReading(point);
  }
}

void LaserDevice::clean(const PioneerRobot& robot) {
  // The half millisecond is for rounding of the time.
  if (clean_interval_ms_ <= 0 || now() - last_clean_s_ < clean_interval_ms_ / 1000 - 0.0005) return;
  last_clean_s_ = now();
  const PioneerTransform global_from_robot(robot.getPose());
  for (const SensorReading& beam : raw_) {
    const PioneerPose from = global_from_robot.doTransform({beam.sensor_x, beam.sensor_y, 0});
    const PioneerPose to{beam.x, beam.y, 0};
    cumulative().removeIf([&](const RangePoint& point) { return passes(from, to, point, clean_distance_); });
  }
}

void LaserDevice::addCumulative(const PioneerPose& pose) {
  for (const RangePoint& point : getCurrentBuffer()) {
    if (Math::distanceBetween(point.x, point.y, pose.x, pose.y) > insert_cumulative_) continue;
    if (!cumulative().hasPointNear(point.x, point.y, gap_cumulative_)) cumulative().addReading(point);
  }
}

}  // namespace robosim
