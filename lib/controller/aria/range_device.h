#pragma once
#include <string>
#include <utility>

#include "aria/range_buffer.h"

namespace robosim {

class PioneerRobot;

/// A range sensor with a memory, as ARIA's ArRangeDevice: the current buffer contains the latest points, the cumulative
/// buffer a longer history. Points are in the frame of PioneerRobot::getPose() [mm], and do not move with the robot.
///
/// SonarDevice and LaserDevice fill themselves once they are added to a robot (PioneerRobot::addRangeDevice()). A
/// RangeDevice itself contains what a program adds, such as virtual obstacles.
class RangeDevice {
 public:
  /// @param max_range [mm] result of a query that finds nothing
  RangeDevice(std::size_t current_size, std::size_t cumulative_size, std::string name, double max_range)
      : name_(std::move(name)), max_range_(max_range), current_(current_size), cumulative_(cumulative_size) {}
  virtual ~RangeDevice() = default;

  const std::string& getName() const { return name_; }
  /// Called by PioneerRobot::addRangeDevice() and remRangeDevice(). @param robot null for none
  void setRobot(PioneerRobot* robot) { robot_ = robot; }
  PioneerRobot* getRobot() const { return robot_; }
  double getMaxRange() const { return max_range_; }
  void setMaxRange(double mm) { max_range_ = mm; }

  /// Adds a point to both buffers, measured now (at 0 s without a robot).
  virtual void addReading(double x, double y);
  /// Called by the robot once per step: processes its readings, then forgets what the limits below exclude.
  void update();

  /// @name Closest point
  /// Distance [mm] from the robot's centre; getMaxRange() when there is none nearer. Directions and corners are in the
  /// robot's frame (RangeBuffer). Without a robot, that is the frame of the points.
  /// @param angle, reading_pos receive the direction [deg] and the place of the point, in the robot's frame
  ///@{
  double currentReadingPolar(double from_deg, double to_deg, double* angle = nullptr) const;
  double cumulativeReadingPolar(double from_deg, double to_deg, double* angle = nullptr) const;
  double currentReadingBox(double x1, double y1, double x2, double y2, PioneerPose* reading_pos = nullptr) const;
  double cumulativeReadingBox(double x1, double y1, double x2, double y2, PioneerPose* reading_pos = nullptr) const;
  ///@}

  /// @name Buffers
  ///@{
  const RangeBuffer& getCurrentRangeBuffer() const { return current_; }
  const RangeBuffer& getCumulativeRangeBuffer() const { return cumulative_; }
  const std::deque<RangePoint>& getCurrentBuffer() const { return current_.getBuffer(); }
  const std::deque<RangePoint>& getCumulativeBuffer() const { return cumulative_.getBuffer(); }
  void setCurrentBufferSize(std::size_t size) { current_.setSize(size); }
  void setCumulativeBufferSize(std::size_t size) { cumulative_.setSize(size); }
  void clearCurrentReadings() { current_.clear(); }
  void clearCumulativeReadings() { cumulative_.clear(); }
  void clearCumulativeOlderThan(double ms);
  void applyTransform(const PioneerTransform& transform, bool do_cumulative = true);
  ///@}

  /// @name Limits
  /// Points beyond them are removed. 0, the default, and negative values mean no limit.
  ///@{
  void setMaxSecondsToKeepCurrent(double s) { keep_current_s_ = s; }
  double getMaxSecondsToKeepCurrent() const { return keep_current_s_; }
  void setMaxSecondsToKeepCumulative(double s) { keep_cumulative_s_ = s; }
  double getMaxSecondsToKeepCumulative() const { return keep_cumulative_s_; }
  void setMaxDistToKeepCumulative(double mm) { keep_cumulative_mm_ = mm; }  ///< from the robot's centre
  double getMaxDistToKeepCumulative() const { return keep_cumulative_mm_; }
  ///@}

 protected:
  /// Adds the readings of this step. Called with a robot only.
  virtual void processReadings(PioneerRobot&) {}
  RangeBuffer& current() { return current_; }
  RangeBuffer& cumulative() { return cumulative_; }
  double now() const;  ///< simulation time [s]; 0 without a robot

 private:
  PioneerPose pose() const;
  void filter();

  std::string name_;
  double max_range_;
  RangeBuffer current_, cumulative_;
  double keep_current_s_ = 0, keep_cumulative_s_ = 0, keep_cumulative_mm_ = 0;
  PioneerRobot* robot_ = nullptr;
};

}  // namespace robosim
