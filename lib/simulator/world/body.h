#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "base/rare.h"
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
  double light_cd = 0;                           ///< luminous intensity in all directions [cd]; 0: no light
  double fiducial = 0;  ///< number of the mark that fiducial sensors read on it, whole; 0: it has none
  bool operator==(const Body&) const = default;

  Solid solid() const;
  /// Radius [m] of the smallest disc about the centre that covers it in plan.
  double coveringRadius() const;
  HeightSpan heights() const { return {center_z_m - height_m / 2, center_z_m + height_m / 2}; }
  /// Whether it is no obstacle but part of the floor, whose colour ground sensors read: nothing of it is above 0.
  bool isFloor() const { return heights().z_max_m <= 0; }
};

/// A number that a body may have, and which most do not have. Reading, writing, digest, interventions and the command
/// line follow from the table.
struct BodyProperty {
  const char* name;  ///< in files: <light>
  double Body::*value;
  double max;  ///< the least is 0, its default
  bool is_whole;
  const char* unit;  ///< of an option of the command line
  const char* help;
};
inline constexpr std::array kBodyProperties{
    BodyProperty{"light", &Body::light_cd, 1e6, false, "CANDELA", "luminous intensity; 0 gives off none"},
    BodyProperty{"fiducial", &Body::fiducial, 65535, true, "NUMBER", "of its fiducial mark; 0 for none"}};

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

/// How far a walker has come.
struct Walk {
  std::uint32_t leg = 0;           ///< index of the place to which it walks
  bool is_returning = false;       ///< it walks its route backwards
  std::uint32_t waited_steps = 0;  ///< since it last walked
  bool operator==(const Walk&) const = default;
};

/// How a person walks, an upright cylinder (doc/moving_objects.md). It stops before whatever is in its way, and turns
/// back after kPatience_s. Nothing pushes it.
struct Walker {
  static constexpr double kPatience_s = 5;

  mrpt::math::TPoint2D home = {};                ///< where it starts, world frame
  std::vector<mrpt::math::TPoint2D> route = {};  ///< where it walks from home, and then home again; empty: at random
  double wanders_within_m = 0;                   ///< of home, without a route: to one random place after another
  double speed_mps = 1.3;                        ///< > 0
  double stops_within_m = 0.5;                   ///< of its rim: it stops before robots, doors and walkers ahead
  Walk walk = {};                                ///< at present
  bool operator==(const Walker&) const = default;

  /// Of the random numbers of the walker of a name.
  static std::uint32_t streamOf(const std::string& name);
  /// Where it walks to on a leg.
  /// @param seed of the run @param stream streamOf() its name
  mrpt::math::TPoint2D targetOf(const Walk&, std::uint64_t seed, std::uint32_t stream) const;
  /// At the end of a leg.
  Walk nextLeg(Walk) const;
  /// When the way of a leg stays blocked.
  Walk turnedBack(Walk) const;
};

/// A belt let into the floor, a box that is not above it, along whose x axis it moves what stands on it
/// (doc/moving_objects.md).
struct Conveyor {
  double speed_mps = 0;  ///< along the box's x axis, signed
  bool operator==(const Conveyor&) const = default;
};

struct WorldObject {
  std::string name;
  Body body;
  Rare<Movable> movable = {};    ///< nullopt: robots do not push it
  Rare<Door> door = {};          ///< its body is a box
  Rare<Walker> walker = {};      ///< its body is a cylinder
  Rare<Conveyor> conveyor = {};  ///< its body is a box. An object has at most one of these four
  SourceLine line;
  bool operator==(const WorldObject&) const = default;

  /// Whether it never moves.
  bool isStationary() const { return !movable && !door && !walker; }
};

}  // namespace robosim
