#pragma once
#include <cstddef>

#include "base/quads.h"
#include "sensors/sensor.h"

namespace robosim {

/// Four rays in a plane, one in each lane.
struct RayQuad {
  DoubleQuad x, y, direction_x, direction_y;
};

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
    age_.share -= step_share_;
    const double cos = age_.half_cos * half_step_cos_ + age_.half_sin * half_step_sin_;
    age_.half_sin = age_.half_sin * half_step_cos_ - age_.half_cos * half_step_sin_;
    age_.half_cos = cos;
  }
  mrpt::math::TPoint3D pointToWorld(const mrpt::math::TPoint3D& in_robot) const {
    const Place<double> at = place(age_);
    return now_.pointToWorld(mrpt::math::TPoint3D(at.x + at.cos * in_robot.x - at.sin * in_robot.y,
                                                  at.y + at.sin * in_robot.x + at.cos * in_robot.y, in_robot.z));
  }
  mrpt::math::TPoint3D turnToWorld(const mrpt::math::TPoint3D& in_robot) const {
    const Place<double> at = place(age_);
    return now_.turnToWorld(mrpt::math::TPoint3D(at.cos * in_robot.x - at.sin * in_robot.y,
                                                 at.sin * in_robot.x + at.cos * in_robot.y, in_robot.z));
  }

  /// How long before the time step poses lie.
  template <typename Number>
  struct Age {
    Number share;               ///< in durations of the last motion
    Number half_cos, half_sin;  ///< of half the turn from the pose to now
  };
  const Age<double>& age() const { return age_; }
  /// The same as pointToWorld() and turnToWorld(), of rays in the robot's frame, each at a pose of its own.
  [[gnu::always_inline]] void toWorld(const Age<DoubleQuad>& ages, RayQuad& rays) const {
    const Place<DoubleQuad> at = place(ages);
    const DoubleQuad x = at.x + at.cos * rays.x - at.sin * rays.y, y = at.y + at.sin * rays.x + at.cos * rays.y;
    rays.x = now_.x() + now_.cos() * x - now_.sin() * y;
    rays.y = now_.y() + now_.sin() * x + now_.cos() * y;
    const DoubleQuad ahead = at.cos * rays.direction_x - at.sin * rays.direction_y;
    const DoubleQuad aside = at.sin * rays.direction_x + at.cos * rays.direction_y;
    rays.direction_x = now_.cos() * ahead - now_.sin() * aside;
    rays.direction_y = now_.sin() * ahead + now_.cos() * aside;
  }

 private:
  /// Poses in the frame of now.
  template <typename Number>
  struct Place {
    Number x, y;
    Number cos, sin;  ///< of the heading
  };
  template <typename Number>
  [[gnu::always_inline]] Place<Number> place(const Age<Number>& age) const {
    // The chord of an arc has the direction of its middle.
    const Number chord_m = is_straight_ ? length_m_ * age.share : diameter_m_ * age.half_sin;
    Place<Number> at;
    at.x = -chord_m * age.half_cos;
    at.y = chord_m * age.half_sin;
    if constexpr (kIsAside) {
      const Number aside_m = is_straight_ ? lateral_m_ * age.share : lateral_diameter_m_ * age.half_sin;
      at.x -= aside_m * age.half_sin;
      at.y -= aside_m * age.half_cos;
    }
    at.cos = age.half_cos * age.half_cos - age.half_sin * age.half_sin;
    at.sin = -2 * age.half_sin * age.half_cos;
    return at;
  }

  PlanarTransform now_;
  double length_m_, lateral_m_;  ///< of the whole last motion
  double diameter_m_;            ///< of the arc of length_m_; unused for a straight motion
  double lateral_diameter_m_;    ///< of the arc of lateral_m_
  bool is_straight_;
  double step_share_;
  double half_step_cos_, half_step_sin_;  ///< of half the turn between two poses
  Age<double> age_;
};

using SweptPose = SweptPoseOf<false>;
using SweptPoseAside = SweptPoseOf<true>;

}  // namespace robosim
