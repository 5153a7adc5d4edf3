#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/path.h"
#include "geometry/shapes/solid.h"

namespace robosim {

/// An object in a robot's gripper, which moves with the robot as one body. Moves are authorised for two discs then: the
/// robot's, and the one that covers the object.
struct HeldObject {
  std::uint32_t robot = 0;   ///< index in the world
  std::uint32_t object = 0;  ///< index among the movable objects
  mrpt::math::TPose2D robot_from_object;
  double radius_m = 0;  ///< of the disc about its centre that covers it
  HeightSpan heights;

  mrpt::math::TPose2D poseAt(const mrpt::math::TPose2D& world_from_robot) const;
  /// The path of its centre while its robot drives a path, with the same end. A point of a body that drives along an
  /// arc moves along an arc, too.
  Path pathOf(const Path& of_robot) const;
  /// Distance of the farthest point of the disc from the robot's centre [m].
  double extent() const;
};

/// What a robot holds; null for nothing. @param held in ascending order of robots
const HeldObject* heldBy(std::span<const HeldObject> held, std::size_t robot);
/// The place in the list of an object that a robot holds. @param object index among the movable objects
std::optional<std::uint32_t> heldIndexOf(std::span<const HeldObject> held, std::size_t object);

}  // namespace robosim
