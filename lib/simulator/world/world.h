#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/rare.h"
#include "base/xml_element.h"
#include "geometry/shapes/solid.h"
#include "world/body.h"
#include "world/communication.h"
#include "world/floor_plan.h"
#include "world/georeference.h"
#include "world/intervention.h"
#include "world/map_reader.h"

namespace robosim {

/// A map placed in the world; its occupied cells become walls, or, without height, a picture on the floor.
struct WorldMap {
  std::string file;    ///< path relative to the world file's folder
  MapReading reading;  ///< how the file is read
  mrpt::math::TPose2D world_from_map;
  double height_m = 1;                           ///< of the walls; 0: they are painted on the floor
  std::array<float, 3> color{0.5f, 0.5f, 0.5f};  ///< red, green, blue, each in [0, 1]
  FloorPlan plan;                                ///< contents of the file
  SourceLine line;
  bool operator==(const WorldMap&) const = default;

  HeightSpan heights() const { return {0, height_m}; }
  bool isFloor() const { return height_m == 0; }
};

/// A robot as placed by the world file. The module `robots` interprets its model and its sensor elements.
struct RobotPlacement {
  std::string name;
  std::string model;  ///< refers to worlds/robots/<model>.xml; empty for a robot described in the file (2005)
  mrpt::math::TPose2D world_from_robot;  ///< start
  Rare<Body> body;  ///< from <cylinder> or <cube>; absent: the model's. Its pose is world_from_robot
  std::optional<std::array<float, 3>> color;  ///< instead of the model's, when `body` is absent
  std::vector<XmlElement>
      sensors;             ///< 2005's <sensor> elements and those inside <sensors>, in file units, not yet interpreted
  Rare<XmlElement> drive;  ///< instead of the model's; not yet interpreted
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
  std::optional<GeoReference> georeference;  ///< of the file; georeferenceOf() is also that of a map
  std::vector<WorldObject> objects;
  std::vector<WorldMap> maps;
  std::vector<RobotPlacement> robots;
  std::vector<Scatter> scatters;      ///< not yet placed
  std::vector<TimedChange> timeline;  ///< by time; of equal times in the file's order
  WorldOrigin origin;
  bool operator==(const World&) const = default;

  /// Path of the file of a line, for errors, in a world read from `world_file`.
  std::string fileOf(const SourceLine& line, const std::string& world_file) const;
};

/// Unknown cells of a map as boxes of the map's height. They are no obstacles.
std::vector<Solid> unknownSolids(const WorldMap&);

/// All solids but robots, as they are at the start: first the objects, in their order, then those of each map.
std::vector<Solid> startSolids(const World&);
/// Those that never move: the stationary ones of some objects, in their order, then the solids of each map.
std::vector<Solid> stationarySolids(const std::vector<WorldObject>& objects, const std::vector<WorldMap>& maps);

}  // namespace robosim
