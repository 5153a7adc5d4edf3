#pragma once
#include <cmath>

#include "aria/pioneer_pose.h"

namespace robosim {

/// Sums of the distance driven, forwards or backwards, the angle turned, to either side, and the time, as ARIA's
/// odometer.
class Odometer {
 public:
  /// Adds the motion since the last call. @param odometry pose by odometry; must not jump
  void update(const PioneerPose& odometry, double time_s) {
    distance_mm_ += odometry.findDistanceTo(last_);
    angle_deg_ += std::abs(Math::subAngle(odometry.th, last_.th));
    last_ = odometry;
    time_s_ = time_s;
  }
  void reset() {
    distance_mm_ = angle_deg_ = 0;
    start_s_ = time_s_;
  }
  double distance() const { return distance_mm_; }       ///< [mm]
  double degrees() const { return angle_deg_; }          ///< [deg]
  double seconds() const { return time_s_ - start_s_; }  ///< since the last reset(), or the start of the run

 private:
  PioneerPose last_;  // odometry starts at the origin
  double distance_mm_ = 0, angle_deg_ = 0;
  double time_s_ = 0, start_s_ = 0;
};

}  // namespace robosim
