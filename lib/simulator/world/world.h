#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/xml_element.h"
#include "geometry/shapes/solid.h"
#include "world/floor_plan.h"
#include "world/map_reader.h"

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

struct WorldObject {
  std::string name;
  Body body;
  bool stationary = true;  ///< kept for the file format only: objects other than robots never move
  SourceLine line;
  bool operator==(const WorldObject&) const = default;
};

/// A map placed in the world; its occupied cells become walls.
struct WorldMap {
  std::string file;    ///< path relative to the world file's folder
  MapReading reading;  ///< how the file is read
  mrpt::math::TPose2D world_from_map;
  double height_m = 1;                           ///< of the walls, > 0
  std::array<float, 3> color{0.5f, 0.5f, 0.5f};  ///< red, green, blue, each in [0, 1]
  FloorPlan plan;                                ///< contents of the file
  SourceLine line;
  bool operator==(const WorldMap&) const = default;

  HeightSpan heights() const { return {0, height_m}; }
};

/// A robot as placed by the world file. The module `robots` interprets its model and its sensor elements.
struct RobotPlacement {
  std::string name;
  std::string model;  ///< refers to worlds/robots/<model>.xml; empty for a robot described in the file (2005)
  mrpt::math::TPose2D world_from_robot;  ///< start
  std::optional<Body> body;  ///< from <cylinder> or <cube>; absent: the model's. Its pose is world_from_robot
  std::optional<std::array<float, 3>> color;  ///< instead of the model's, when `body` is absent
  std::vector<XmlElement>
      sensors;             ///< 2005's <sensor> elements and those inside <sensors>, in file units, not yet interpreted
  std::string controller;  ///< as TypeChoice::text(), not yet checked; empty: the program's default
  SourceLine controller_line;
  std::string neighbour;  ///< empty: none
  SourceLine line;
  bool operator==(const RobotPlacement&) const = default;
};

enum class ScatterPattern {
  uniform,  ///< random places
  free,     ///< random places in the largest connected free part of the area; unknown cells of maps are not free
  grid,     ///< rows and columns as far apart as possible, from the lower left
  ring,     ///< on a circle, as far apart as possible, from its positive x axis counter-clockwise
};

/// Copies of a robot or an object, at places that do not overlap. placeScattered() (robots/scatter.h) replaces it by
/// them.
struct Scatter {
  int count = 1;  ///< at most kScatteredMax in a world
  ScatterPattern pattern = ScatterPattern::uniform;
  std::optional<Bounds2D> area;         ///< in which they lie; nullopt: the surface; unused by a ring
  mrpt::math::TPoint2D ring_center;     ///< world frame [m]
  double ring_radius_m = 0;             ///< of the circle of their centres; > 0 for a ring
  double gap_m = 0;                     ///< minimum distance to each other and to anything else, >= 0
  std::optional<double> direction_rad;  ///< nullopt: random
  std::variant<RobotPlacement, WorldObject>
      copied;                       ///< its name is followed by the number: 1, 2, …; its pose is unused
  bool has_neighbour_ring = false;  ///< robots: each has the next as its neighbour, and the last has the first
  SourceLine line;
  bool operator==(const Scatter&) const = default;

  /// Name of the copy with this number.
  std::string nameOf(int number) const;
  /// Name of the neighbour of the copy with this number; empty: none.
  std::string neighbourOf(int number) const;
};

/// Maximum number of scattered robots and objects in a world; bounds the memory that a short file takes.
constexpr int kScatteredMax = 250'000;

/// How a world was made. All compare equal, because this is not part of the value.
struct WorldOrigin {
  std::vector<std::string> included;  ///< FileProvider names of the included files; SourceLine::file counts them from 1
  bool is_scattered = false;          ///< some of its places depend on the seed
  bool operator==(const WorldOrigin&) const { return true; }
};

/// Limits and errors of the robots' communication (environment/radio_channel.h).
struct Communication {
  std::optional<double> range_m = std::nullopt;  ///< between robots' centres; nullopt: unlimited
  double loss_probability = 0;                   ///< of each message, [0, 1]
  double wall_range_m = 0;                       ///< range that each wall between the robots takes, [0, 1e9]
  double wall_loss = 0;                          ///< probability that a message is lost at each wall, [0, 1]
  double burst_gap_s = 0;                        ///< mean time between bursts of losses, [0, 3600]; 0: there are none
  double burst_s = 1;                            ///< mean duration of a burst, (0, 3600]
  double burst_loss = 1;                         ///< probability that a message is lost in a burst, [0, 1]
  double delay_s = 0;                            ///< beyond the next step, rounded up to whole steps, [0, 60]
  double rate_hz = 0;                            ///< messages that a robot may send per second, [0, 1e6]; 0: unlimited
  bool operator==(const Communication&) const = default;

  bool hasWalls() const { return wall_range_m > 0 || wall_loss > 0; }
  bool hasBursts() const { return burst_gap_s > 0 && burst_loss > 0; }
  /// Whether it depends on the run's seed.
  bool isRandom() const { return loss_probability > 0 || wall_loss > 0 || hasBursts(); }
};

/// Default of the maximum distance to the gold, from outline to outline, at which a robot wins: an operator can judge
/// it by eye, and it does not reach through a wall into the next cell of the mazes.
constexpr double kWinDistance_m = 0.5;

/// Contents of a world file in SI units, constant during a run.
struct World {
  std::string name;  ///< the file's stem, not stored in the file
  std::string surface_type = "smooth";
  double unit_m = 1;  ///< one length unit of the file, in metres
  Bounds2D bounds;    ///< area of the surface, within which robots start
  Communication communication;
  double win_distance_m = kWinDistance_m;  ///< maximum distance to the gold at which checkWin() succeeds
  /// Minimum distance of random starts from the gold, from a robot's centre to the gold's outline; nullopt: that of
  /// RandomStarts.
  std::optional<double> start_distance_m;
  std::vector<WorldObject> objects;
  std::vector<WorldMap> maps;
  std::vector<RobotPlacement> robots;
  std::vector<Scatter> scatters;  ///< not yet placed
  WorldOrigin origin;
  bool operator==(const World&) const = default;

  /// Path of the file of a line, for errors, in a world read from `world_file`.
  std::string fileOf(const SourceLine& line, const std::string& world_file) const;
};

/// Unknown cells of a map as boxes of the map's height. They are no obstacles.
std::vector<Solid> unknownOf(const WorldMap&);

/// All stationary solids: first the objects, in their order, then those of each map.
std::vector<Solid> stationarySolids(const World&);

}  // namespace robosim
