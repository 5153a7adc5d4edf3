#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/random.h"
#include "robots/fleet.h"
#include "robots/free_space.h"

namespace robosim {

/// The positions in the largest region that is known to be free at which a robot of a kind is clear of all others.
class FreePlaces {
 public:
  /// @param world must outlive this @param others robots that are in the world already
  FreePlaces(const World& world, const Fleet& others, FleetRobot kind);

  /// Takes a random place. @return nullopt when there is none
  std::optional<mrpt::math::TPoint2D> takeRandom(Rng& rng);
  /// A random place of the region, whether it is clear of robots or not. @return nullopt when the region is empty
  std::optional<mrpt::math::TPoint2D> draw(Rng& rng) const;
  /// Takes the place nearest to a position. @param clearance_m to other robots
  /// @param is_wanted further condition on a place; null: none @return nullopt when there is none
  std::optional<mrpt::math::TPoint2D> takeNearest(
      const mrpt::math::TPoint2D& to, double clearance_m = 0,
      const std::function<bool(const mrpt::math::TPoint2D&)>& is_wanted = {});
  /// Takes this very position. @return whether it is in the region and free
  bool takeAt(const mrpt::math::TPoint2D& place, double clearance_m);

 private:
  bool take(const mrpt::math::TPoint2D& place, double clearance_m = 0);

  const World& world_;
  FleetRobot kind_;
  FreeSpace free_;
  std::vector<std::size_t> cells_;
  std::vector<Circle> taken_;
};

/// A start that findStart() has found.
struct FoundStart {
  mrpt::math::TPose2D world_from_robot;
  std::string warning = {};  ///< why the robot does not stand at the first start; empty if it does
};

/// The rule by which each command places a robot without a place of its own: at the first of some starts, such as the
/// homes of a map, where it is clear of walls and robots; else at the free place nearest to the first start, with its
/// heading.
/// @param world with the robots placed so far; unchanged afterwards @param starts at least one
/// @return nullopt when there is no room
/// @throws ConfigError for faulty robots in the world, an unknown type, and a world too large for FreeSpace
std::optional<FoundStart> findStart(World& world, const std::string& world_file, const RobotTypes& types,
                                    const RobotPlacement& robot, const std::vector<mrpt::math::TPose2D>& starts);

/// Clearance that findStartBeside() keeps between robots [m].
constexpr double kClearanceBeside_m = 1;

/// The rule by which a robot without a place of its own joins the robots of a world: to the left of one of them or to
/// its right, else behind one, at kClearanceBeside_m and with its heading; the robots are tried in their order. Where
/// none of these places is free: at the place nearest to the first robot with that clearance, rather beside and behind
/// it than ahead; and where there is none, at the nearest free place.
/// @param world has at least one robot @return nullopt when there is no room
/// @throws ConfigError for faulty robots in the world, an unknown type, and a world too large for FreeSpace
std::optional<mrpt::math::TPose2D> findStartBeside(const World& world, const std::string& world_file,
                                                   const RobotTypes& types, const std::string& type);

/// The starts that the maps of a world give, in the world frame, in their order.
std::vector<mrpt::math::TPose2D> startsOfMaps(const World& world);

/// Whether a robot stands at a start that a map gives.
bool hasRobotsAtMapStarts(const World& world);

/// Moves the robots that stand at the starts of maps and overlap something, by findStart(). Where there is no room, the
/// robot of a bare map is left out; another one is an error.
/// @return "file:line: what was moved"
std::vector<std::string> moveFromBlockedStarts(World& world, const std::string& world_file, const RobotTypes& types,
                                               ErrorList& errors);

}  // namespace robosim
