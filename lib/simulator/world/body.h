#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>

#include <mrpt/math/TPose2D.h>

#include "base/xml_element.h"
#include "geometry/shapes/solid.h"

namespace robosim {

struct Cylinder {
  double radius_m = 0;
  bool operator==(const Cylinder&) const = default;
};
struct Cube {           ///< a box, named as in 2005
  double length_m = 0;  ///< along the body's x axis
  double width_m = 0;
  bool operator==(const Cube&) const = default;
};

/// Default of Body::reflectivity: painted walls and wood return 0.4 to 0.8 of near-infrared light.
constexpr double kReflectivity = 0.5;

/// An upright solid with colour and temperature, as described by <cylinder> or <cube> of a 2005 file.
struct Body {
  std::variant<Cylinder, Cube> shape;
  mrpt::math::TPose2D world_from_body;           ///< of its centre, in plan; phi is the file's direction [rad]
  double center_z_m = 0;                         ///< height of its centre above the ground
  double height_m = 0;                           ///< > 0
  std::array<float, 3> color{0.5f, 0.5f, 0.5f};  ///< red, green, blue, each in [0, 1]
  double heat_celsius = 0;                       ///< the file's `hot`; 0 gives off no heat
  double reflectivity = kReflectivity;           ///< share of a laser's light that it returns, [0, 1]
  bool operator==(const Body&) const = default;

  Solid solid() const;
  /// Radius [m] of the smallest disc about the centre that covers it in plan.
  double coveringRadius() const;
  HeightSpan heights() const { return {center_z_m - height_m / 2, center_z_m + height_m / 2}; }
};

/// How an object moves that robots push (doc/moving_objects.md). It stands with its whole base on the floor.
struct Movable {
  double mass_kg = 1;      ///< > 0
  double friction = 0.5;   ///< its coefficient on the floor, >= 0; of rolling for a ball
  double restitution = 0;  ///< [0, 1]: share of the speed with which it leaves a collision
  bool operator==(const Movable&) const = default;

  /// Of an object of a 2005 file, which states only that it is not stationary: as heavy as filled cardboard boxes are,
  /// 100 kg/m³.
  static Movable byVolumeOf(const Body&);
};

/// How a door moves between the place where it is closed and the one where it is open (doc/moving_objects.md). Nothing
/// pushes it; what is in its way stops it.
struct Door {
  mrpt::math::TPose2D world_from_closed = {};  ///< of its centre when it is closed
  double slide_m = 0;                          ///< when open, along its x axis, signed; 0 for one that turns
  double turn_rad = 0;        ///< when open, about the middle of its side at -x, signed; 0 for one that slides
  double speed = 0.5;         ///< > 0; m/s, or rad/s of one that turns
  double opens_within_m = 0;  ///< of a robot's disc; 0: for no robot
  double open_to = 0;         ///< share to which it opens without a robot nearby, [0, 1]
  double share = 0;           ///< to which it is open at present, [0, 1]
  bool operator==(const Door&) const = default;

  /// @param length_m of its body
  mrpt::math::TPose2D poseAt(double at_share, double length_m) const;
  /// The share by which it moves in a second.
  double shareRate() const;
};

struct WorldObject {
  std::string name;
  Body body;
  std::optional<Movable> movable = {};  ///< nullopt: robots do not push it
  std::optional<Door> door = {};        ///< not with `movable`; its body is a box
  SourceLine line;
  bool operator==(const WorldObject&) const = default;

  /// Whether it never moves.
  bool isStationary() const { return !movable && !door; }
};

}  // namespace robosim
