#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "dynamics/held_object.h"
#include "dynamics/movable_body.h"
#include "geometry/scene.h"
#include "geometry/shapes/path.h"

namespace robosim {

/// How a door or a walker is to move in a step, unless something stops it on its way.
struct DrivenPlan {
  double door_share = 0;                       ///< of a door, to which it is open at the end
  mrpt::math::TPose2D world_from_object = {};  ///< of a walker, at the end; it walks there in a straight line
  Walk walk = {};                              ///< of a walker, at the end
  double way_m = 0;                            ///< no point of the body moves farther; 0: it stays where it is
};

/// What plans are made from: a step's start. The references must remain valid.
struct DrivenSurroundings {
  const Scene& scene;  ///< its moving solids are the robots, then the objects
  const Bounds2D& surface;
  std::span<const MovableBody> bodies;
  std::span<const ObjectMotion> objects;
  std::span<const PushingDisc> robots;
  std::span<const HeldObject> held;
  std::span<const Path> paths;  ///< of the robots
  double period_s;
  std::uint64_t seed;
};

/// Plans the motion of all doors and walkers, by object. No two of them come to overlap, whatever else happens: each
/// keeps away from all places that another may reach in the step, so the order has no influence.
///
/// A door opens while a robot or a walker is near it where it is closed, if it has a sensor, and otherwise to
/// ObjectMotion::open_to. A walker walks to the places of its route, or to random ones, and stops before robots, doors
/// and walkers on its way, and before stationary solids, which a random way leads to.
std::vector<DrivenPlan> planDriven(const DrivenSurroundings& around);

}  // namespace robosim
