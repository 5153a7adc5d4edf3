#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/xml_element.h"
#include "geometry/solid.h"

namespace robosim {

struct Cylinder {
  double radius_m = 0;
  bool operator==(const Cylinder&) const = default;
};
struct Cube {           ///< the 2005 word for a box
  double length_m = 0;  ///< along the body's x axis
  double width_m = 0;
  bool operator==(const Cube&) const = default;
};

/// An upright solid with a look and a temperature: what a 2005 file says in <cylinder> or <cube>.
struct Body {
  std::variant<Cylinder, Cube> shape;
  mrpt::math::TPose2D world_from_body;           ///< of its centre, in plan; phi is the file's direction [rad]
  double center_z_m = 0;                         ///< height of its centre above the ground
  double height_m = 0;                           ///< > 0
  std::array<float, 3> color{0.5f, 0.5f, 0.5f};  ///< red, green, blue, each in [0, 1]
  double heat_celsius = 0;                       ///< the file's `hot`; 0 gives off no heat
  bool operator==(const Body&) const = default;

  Solid solid() const;
  /// Radius [m] of the smallest disc about the centre that covers it in plan.
  double coveringRadius() const;
  HeightSpan heights() const { return {center_z_m - height_m / 2, center_z_m + height_m / 2}; }
};

struct WorldObject {
  std::string name;
  Body body;
  bool stationary = true;  ///< kept for the file's sake: nothing moves an object that is no robot
  SourceLine line;
  bool operator==(const WorldObject&) const = default;
};

/// A robot as the world file places it. What its model and its sensor elements mean is told by the room `robots`.
struct RobotPlacement {
  std::string name;
  std::string model;  ///< names worlds/robots/<model>.xml; empty for a robot that the file describes itself (2005)
  mrpt::math::TPose2D world_from_robot;  ///< start
  std::optional<Body> body;  ///< from <cylinder> or <cube>; absent: the model's. Its pose is world_from_robot
  std::optional<std::array<float, 3>> color;  ///< instead of the model's, when `body` is absent
  std::vector<XmlElement>
      sensors;             ///< 2005's <sensor> elements and those inside <sensors>, in file units, unread as yet
  std::string controller;  ///< empty: whatever the program runs by default
  std::string neighbour;   ///< empty: none
  SourceLine line;
  bool operator==(const RobotPlacement&) const = default;
};

/// How far robots can talk.
struct Communication {
  std::optional<double> range_m;  ///< between robots' centres; nullopt: everywhere
  double loss_probability = 0;    ///< [0, 1], of each message
  bool operator==(const Communication&) const = default;
};

/// How near to the gold a robot must be to win, from outline to outline, unless the world says otherwise: a step that a
/// driver can take in by eye, and less than would reach through a wall into the next cell of the mazes.
constexpr double kWinDistance_m = 0.5;

/// What a world file says, in SI units: everything that is constant over a run. Plain values.
struct World {
  std::string name;  ///< the file's stem; no part of the file's text
  std::string surface_type = "smooth";
  double unit_m = 1;  ///< one length unit of the file, in metres
  Bounds2D bounds;    ///< robots start inside
  Communication communication;
  double win_distance_m = kWinDistance_m;  ///< a robot that is this near to the gold has won, when it asks
  std::vector<WorldObject> objects;
  std::vector<RobotPlacement> robots;
  bool operator==(const World&) const = default;
};

}  // namespace robosim
