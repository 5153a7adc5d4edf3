#pragma once
#include "sensors/sensor.h"

namespace robosim {

/// Poses of a robot at equally spaced times before the time step, on the arc of its last motion: exact while speed and
/// turn rate are constant. Successive poses are computed by rotation, without further sines.
/// @tparam kIsAside whether the motion may have a lateral part
template <bool kIsAside>
class SweptPoseOf {
 public:
  /// @param now pose at the time step
  /// @param first_share age of the first pose, in durations of the last motion
  /// @param step_share by which each pose is younger than the one before
  SweptPoseOf(const PlanarTransform& now, const Motion& last_motion, double first_share, double step_share);

  /// Advances to the next pose.
  void next() {
    share_ -= step_share_;
    const double cos = half_cos_ * half_step_cos_ + half_sin_ * half_step_sin_;
    half_sin_ = half_sin_ * half_step_cos_ - half_cos_ * half_step_sin_;
    half_cos_ = cos;
    place();
  }
  mrpt::math::TPoint3D pointToWorld(const mrpt::math::TPoint3D& in_robot) const {
    return now_.pointToWorld(mrpt::math::TPoint3D(x_ + cos_ * in_robot.x - sin_ * in_robot.y,
                                                  y_ + sin_ * in_robot.x + cos_ * in_robot.y, in_robot.z));
  }
  mrpt::math::TPoint3D turnToWorld(const mrpt::math::TPoint3D& in_robot) const {
    return now_.turnToWorld(
        mrpt::math::TPoint3D(cos_ * in_robot.x - sin_ * in_robot.y, sin_ * in_robot.x + cos_ * in_robot.y, in_robot.z));
  }

 private:
  void place() {
    // The chord of an arc has the direction of its middle.
    const double chord_m = is_straight_ ? length_m_ * share_ : diameter_m_ * half_sin_;
    x_ = -chord_m * half_cos_;
    y_ = chord_m * half_sin_;
    if constexpr (kIsAside) placeAside();
    cos_ = half_cos_ * half_cos_ - half_sin_ * half_sin_;
    sin_ = -2 * half_sin_ * half_cos_;
  }
  /// Of a motion that is not only along the heading.
  void placeAside() {
    const double chord_m = is_straight_ ? lateral_m_ * share_ : lateral_diameter_m_ * half_sin_;
    x_ -= chord_m * half_sin_;
    y_ -= chord_m * half_cos_;
  }

  PlanarTransform now_;
  double length_m_, lateral_m_;  ///< of the whole last motion
  double diameter_m_;            ///< of the arc of length_m_; unused for a straight motion
  double lateral_diameter_m_;    ///< of the arc of lateral_m_
  bool is_straight_;
  double share_, step_share_;
  double half_cos_, half_sin_;            ///< of half the turn from the pose to now
  double half_step_cos_, half_step_sin_;  ///< of half the turn between two poses
  double x_ = 0, y_ = 0;                  ///< of the pose, in the frame of now
  double cos_ = 1, sin_ = 0;              ///< of the heading, in the frame of now
};

using SweptPose = SweptPoseOf<false>;
using SweptPoseAside = SweptPoseOf<true>;

}  // namespace robosim
