#pragma once
#include <array>
#include <optional>

#include "geometry/scene.h"
#include "sensors/sonar_noise.h"

namespace robosim {

/// An echo as the ping of a sonar finds it, world frame.
struct SonarEcho {
  double range_m = 0;
  mrpt::math::TPoint3D direction;  ///< in which it appears, unit vector
  mrpt::math::TPoint3D point;      ///< where the ping meets the body
  bool operator==(const SonarEcho&) const = default;
};

/// Reflects the pings of sonars from bodies. A body returns a direct echo when the sonar's lobe covers its nearest
/// point (SonarLobe) or when its surface faces the sonar (SonarNoise::specular_rad). A ping that a surface reflects
/// away may return from the next one: along the same way when that surface faces it, or from a right-angled corner,
/// which sends every ping back (a corner reflector), as if from its apex. Then the range is half the length of the way,
/// longer than the first surface's (Harris & Recce, "Experimental modelling of time-of-flight sonar", Robotics and
/// Autonomous Systems 24, 1998, who distinguish direct and multiple specular returns of walls). Omitted: more than two
/// surfaces, and pings by way of the robot's own body.
class SonarReflector {
 public:
  /// @param noise must outlive this object
  SonarReflector(const SonarNoise& noise, double range_max_m);

  /// The direct echo from a body that the ping has met; nullopt when it does not return.
  /// @param axis of the sonar, world frame @param owner its robot @param met nearest in the beam
  std::optional<SonarEcho> direct(const Scene&, BodyId owner, const Ray& axis, const SonarEcho& met, BodyId body) const;
  /// The echo by way of a second surface, of a ping that met the first at `met`.
  std::optional<SonarEcho> second(const Scene&, BodyId owner, const Ray& axis, const SonarEcho& met, BodyId body) const;

 private:
  std::optional<SonarEcho> fromCorner(const Ray& axis, const mrpt::math::TPoint3D& at,
                                      const mrpt::math::TPoint2D& normal, const mrpt::math::TPoint3D& next_at,
                                      const mrpt::math::TPoint2D& next) const;
  /// Whether the lobe covers a target, by the cosine of its angle from the axis.
  bool covers(double ahead, double range_m, SonarTarget target) const;
  bool faces(const mrpt::math::TPoint3D& direction, const mrpt::math::TPoint2D& normal, double range_m) const;

  const SonarNoise& noise_;
  double range_max_m_;
  double specular_cosine_;
  /// By target: cosines of the smallest and the largest angle of the lobe at any range, which decide most cases.
  std::array<double, 2> always_, ever_;
};

}  // namespace robosim
