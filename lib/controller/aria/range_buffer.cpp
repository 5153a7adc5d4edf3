#include "aria/range_buffer.h"

namespace robosim {
namespace {

double squaredDistance(const RangePoint& point, double x, double y) {
  return (point.x - x) * (point.x - x) + (point.y - y) * (point.y - y);
}

}  // namespace

std::optional<ClosestPoint> nearerOf(const std::optional<ClosestPoint>& a, const std::optional<ClosestPoint>& b) {
  if (!a || !b) return a ? a : b;
  return b->distance < a->distance ? b : a;
}

void RangeBuffer::setSize(std::size_t size) {
  size_ = size;
  if (points_.size() > size) points_.resize(size);
}

void RangeBuffer::addReading(const RangePoint& point) {
  points_.push_front(point);
  if (points_.size() > size_) points_.pop_back();
}

void RangeBuffer::replaceNear(const RangePoint& point, double min_distance) {
  removeIf([&](const RangePoint& old) { return squaredDistance(old, point.x, point.y) < min_distance * min_distance; });
  addReading(point);
}

bool RangeBuffer::hasPointNear(double x, double y, double distance) const {
  return std::any_of(points_.begin(), points_.end(),
                     [&](const RangePoint& point) { return squaredDistance(point, x, y) < distance * distance; });
}

void RangeBuffer::clearOlderThan(double time_s) {
  removeIf([time_s](const RangePoint& point) { return point.time_s < time_s; });
}

void RangeBuffer::clearFartherThan(const PioneerPose& place, double distance_mm) {
  removeIf(
      [&](const RangePoint& point) { return squaredDistance(point, place.x, place.y) > distance_mm * distance_mm; });
}

void RangeBuffer::applyTransform(const PioneerTransform& transform) {
  for (RangePoint& point : points_) {
    const PioneerPose moved = transform.doTransform({point.x, point.y, 0});
    point.x = moved.x;
    point.y = moved.y;
  }
}

template <typename Accept>
std::optional<ClosestPoint> RangeBuffer::closest(const PioneerPose& robot, const Accept& accept) const {
  const PioneerTransform global_from_local(robot);
  std::optional<ClosestPoint> found;
  for (const RangePoint& point : points_) {
    const PioneerPose local = global_from_local.doInvTransform({point.x, point.y, 0});
    const double distance = Math::distanceBetween(0, 0, local.x, local.y);
    if ((found && distance >= found->distance) || !accept(local)) continue;
    found = {.distance = distance, .angle = Math::atan2(local.y, local.x), .local = {local.x, local.y, 0}};
  }
  return found;
}

std::optional<ClosestPoint> RangeBuffer::getClosestPolar(double from_deg, double to_deg,
                                                         const PioneerPose& robot) const {
  return closest(robot, [&](const PioneerPose& local) {
    return Math::angleBetween(Math::atan2(local.y, local.x), from_deg, to_deg);
  });
}

std::optional<ClosestPoint> RangeBuffer::getClosestBox(double x1, double y1, double x2, double y2,
                                                       const PioneerPose& robot) const {
  const auto x = std::minmax(x1, x2), y = std::minmax(y1, y2);
  return closest(robot, [&](const PioneerPose& local) {
    return x.first <= local.x && local.x <= x.second && y.first <= local.y && local.y <= y.second;
  });
}

}  // namespace robosim
