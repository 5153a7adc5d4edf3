#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel_executor.h"
#include "dynamics/held_object.h"
#include "dynamics/movable_body.h"
#include "dynamics/pushing.h"
#include "geometry/scene.h"

namespace robosim {

/// Moves the movable objects of a world in each step: those that move, those that a robot drives against, and those
/// that these may touch, each in its group (Pushing). Groups are independent of each other, so the result is the same
/// for any number of threads. Nothing is computed for objects at rest. Objects that robots hold push others as robots
/// do.
class ObjectMover {
 public:
  /// @param surface its edge is a wall for objects
  ObjectMover(std::vector<MovableBody> objects, std::vector<Belt> belts, std::vector<PushingDisc> robots,
              const Bounds2D& surface);

  /// Moves the objects for a step.
  /// @param scene frozen at the start of the step; its moving solids are the robots, then the objects
  /// @param held in ascending order of robots; these objects are not moved
  /// @param paths of the robots, authorised: no two collide with each other or with anything stationary. Those of
  ///   robots that an object blocks are shortened (Path::end_fraction)
  /// @param objects of the constructor, in their order
  /// @param seed of the run
  /// @return whether any object may have moved, or a path was shortened
  bool move(const Scene& scene, const ParallelExecutor& workers, double period_s, std::uint64_t seed,
            std::span<const HeldObject> held, std::span<Path> paths, std::span<ObjectMotion> objects);

  const std::vector<MovableBody>& bodies() const { return bodies_; }
  /// The surroundings of the surface as boxes.
  static std::vector<Outline> edgesOf(const Bounds2D& surface);

 private:
  struct Search;

  std::vector<MovableBody> bodies_;
  std::vector<Belt> belts_;
  std::vector<PushingDisc> robots_;
  std::vector<Outline> edges_;
  Bounds2D surface_;
  double cover_max_m_ = 0;   ///< of the objects
  double radius_max_m_ = 0;  ///< of the robots
  double belt_speed_max_mps_ = 0;
  bool has_driven_ = false;  ///< doors or walkers
};

}  // namespace robosim
