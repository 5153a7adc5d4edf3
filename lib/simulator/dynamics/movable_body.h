#pragma once
#include <cstdint>
#include <optional>
#include <variant>

#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/solid.h"
#include "world/body.h"

namespace robosim {

/// What the motion of a movable object depends on, constant between interventions.
///
/// Its weight is spread evenly over its base, so that the friction of the floor resists pushes by force and torque
/// within an ellipsoid, the limit surface (Howe & Cutkosky, "Practical force-motion models for sliding manipulation",
/// IJRR 1996; Lynch & Mason, "Stable pushing", IJRR 1996). Its axes are `friction · weight` and `turn_radius_m` times
/// that. The body's inertia is taken from the same length, as `mass · turn_radius²`: 11 % below that of a homogeneous
/// disc. Then a push from rest and a continued push turn the body alike, and lengths in (x, y, turn_radius · turn)
/// serve both.
struct MovableBody {
  std::variant<Cylinder, Cube> shape;
  HeightSpan heights;
  double mass_kg = 1;
  double friction_n = 0;         ///< force of friction while it moves, >= 0
  double restitution = 0;        ///< [0, 1]
  double turn_radius_m = 1;      ///< mean distance of its base's points from the centre
  double covering_radius_m = 0;  ///< Body::coveringRadius()
  double width_min_m = 0;        ///< of its outline, in its narrowest direction

  /// @name Driven bodies, which move by themselves, as if their mass were infinite
  ///@{
  std::optional<Door> door;
  std::optional<Walker> walker;
  std::uint32_t walker_stream = 0;  ///< Walker::streamOf() the object's name
  bool isDriven() const { return door || walker; }
  ///@}

  /// @pre the object is not stationary
  static MovableBody from(const WorldObject& object);
  Outline outlineAt(const mrpt::math::TPose2D& world_from_object) const;
  /// Where a door is when it is open to a share.
  mrpt::math::TPose2D doorAt(double share) const { return door->poseAt(share, std::get<Cube>(shape).length_m); }
  double deceleration() const { return friction_n / mass_kg; }  ///< while nothing touches it [m/s²]
};

/// Mean distance [m] of the points of a shape from its centre. Disc: two thirds of the radius.
double meanDistance(const std::variant<Cylinder, Cube>& shape);

/// How a movable object moves between two steps.
struct ObjectSpeed {
  double vx_mps = 0, vy_mps = 0;  ///< of its centre, world frame
  double turn_radps = 0;          ///< CCW

  bool isAtRest() const { return vx_mps == 0 && vy_mps == 0 && turn_radps == 0; }
  bool operator==(const ObjectSpeed&) const = default;
};

/// The same, and where it is.
struct ObjectMotion : ObjectSpeed {
  mrpt::math::TPose2D world_from_object;
  double open_to = 0;     ///< Door::open_to, of a door
  double door_share = 0;  ///< Door::share
  Walk walk = {};         ///< Walker::walk
  bool operator==(const ObjectMotion&) const = default;
};

/// The belt of a conveyor. An object whose centre is within it stands on it.
struct Belt {
  OrientedBox area;
  mrpt::math::TPoint2D velocity_mps;  ///< world frame

  /// @pre the object is a conveyor
  static Belt from(const WorldObject& object);
  bool carries(const mrpt::math::TPoint2D& center) const { return distance(area, center) == 0; }
};

/// Robots move as these discs.
struct PushingDisc {
  double radius_m = 0;
  HeightSpan heights;
  double push_max_n = 0;  ///< what it can push
};

}  // namespace robosim
