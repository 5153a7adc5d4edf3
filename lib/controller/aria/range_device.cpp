#include "aria/range_device.h"

#include "aria/pioneer_robot.h"

namespace robosim {
namespace {

/// A query's result as ARIA returns it.
double distanceOf(const std::optional<ClosestPoint>& closest, double max_range, double* angle,
                  PioneerPose* reading_pos) {
  if (!closest || closest->distance > max_range) return max_range;
  if (angle) *angle = closest->angle;
  if (reading_pos) *reading_pos = closest->local;
  return closest->distance;
}

}  // namespace

double RangeDevice::now() const { return robot_ ? robot_->time() : 0; }

PioneerPose RangeDevice::pose() const { return robot_ ? robot_->getPose() : PioneerPose{}; }

void RangeDevice::addReading(double x, double y) {
  current_.addReading({x, y, now()});
  cumulative_.addReading({x, y, now()});
}

void RangeDevice::update() {
  if (robot_) processReadings(*robot_);
  filter();
}

void RangeDevice::filter() {
  // Half a millisecond is for rounding: an age of the limit itself is not beyond it.
  if (keep_current_s_ > 0) current_.clearOlderThan(now() - keep_current_s_ - 0.0005);
  if (keep_cumulative_s_ > 0) cumulative_.clearOlderThan(now() - keep_cumulative_s_ - 0.0005);
  if (keep_cumulative_mm_ > 0) cumulative_.clearFartherThan(pose(), keep_cumulative_mm_);
}

void RangeDevice::clearCumulativeOlderThan(double ms) { cumulative_.clearOlderThan(now() - ms / 1000 - 0.0005); }

void RangeDevice::applyTransform(const PioneerTransform& transform, bool do_cumulative) {
  current_.applyTransform(transform);
  if (do_cumulative) cumulative_.applyTransform(transform);
}

double RangeDevice::currentReadingPolar(double from_deg, double to_deg, double* angle) const {
  return distanceOf(current_.getClosestPolar(from_deg, to_deg, pose()), max_range_, angle, nullptr);
}

double RangeDevice::cumulativeReadingPolar(double from_deg, double to_deg, double* angle) const {
  return distanceOf(cumulative_.getClosestPolar(from_deg, to_deg, pose()), max_range_, angle, nullptr);
}

double RangeDevice::currentReadingBox(double x1, double y1, double x2, double y2, PioneerPose* reading_pos) const {
  return distanceOf(current_.getClosestBox(x1, y1, x2, y2, pose()), max_range_, nullptr, reading_pos);
}

double RangeDevice::cumulativeReadingBox(double x1, double y1, double x2, double y2, PioneerPose* reading_pos) const {
  return distanceOf(cumulative_.getClosestBox(x1, y1, x2, y2, pose()), max_range_, nullptr, reading_pos);
}

}  // namespace robosim
