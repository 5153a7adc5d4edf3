#pragma once
#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>

#include "aria/pioneer_pose.h"

namespace robosim {

/// A point at which a sensor detected something, in the frame of PioneerRobot::getPose() [mm].
struct RangePoint {
  double x = 0, y = 0;
  double time_s = 0;  ///< simulation time of the measurement
  double getX() const { return x; }
  double getY() const { return y; }
  bool operator==(const RangePoint&) const = default;
};

/// The point of a buffer that is closest to the robot's centre, within some region.
struct ClosestPoint {
  double distance = 0;  ///< [mm]
  double angle = 0;     ///< in the robot's frame [deg]
  PioneerPose local;    ///< in the robot's frame [mm]; th is 0
};

/// The nearer of two results; either may be absent.
std::optional<ClosestPoint> nearerOf(const std::optional<ClosestPoint>& a, const std::optional<ClosestPoint>& b);

/// Points of a range sensor, of which the oldest are dropped beyond a maximum number, as ARIA's ArRangeBuffer. All
/// queries take time in proportion to the points.
class RangeBuffer {
 public:
  /// @param size maximum number of points
  explicit RangeBuffer(std::size_t size) : size_(size) {}

  std::size_t getSize() const { return size_; }
  void setSize(std::size_t size);
  void addReading(const RangePoint& point);
  /// Adds a point and removes all that are nearer to it than `min_distance` [mm].
  void replaceNear(const RangePoint& point, double min_distance);
  bool hasPointNear(double x, double y, double distance) const;  ///< strictly nearer than that [mm]
  void clear() { points_.clear(); }
  void clearOlderThan(double time_s);                                   ///< measured before this simulation time
  void clearFartherThan(const PioneerPose& place, double distance_mm);  ///< strictly farther
  template <typename Predicate>
  void removeIf(const Predicate& predicate) {
    std::erase_if(points_, predicate);
  }
  /// Moves all points to another frame.
  void applyTransform(const PioneerTransform& transform);
  /// The points, newest first.
  const std::deque<RangePoint>& getBuffer() const { return points_; }

  /// Closest point to `robot` between two directions in its frame, counter-clockwise from `from_deg` to `to_deg`.
  std::optional<ClosestPoint> getClosestPolar(double from_deg, double to_deg, const PioneerPose& robot) const;
  /// Closest point to `robot` in the rectangle with the opposite corners (x1, y1) and (x2, y2) in its frame.
  std::optional<ClosestPoint> getClosestBox(double x1, double y1, double x2, double y2, const PioneerPose& robot) const;

 private:
  template <typename Accept>
  std::optional<ClosestPoint> closest(const PioneerPose& robot, const Accept& accept) const;

  std::size_t size_;
  std::deque<RangePoint> points_;  ///< newest first
};

}  // namespace robosim
