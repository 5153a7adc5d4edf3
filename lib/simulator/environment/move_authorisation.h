#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel_executor.h"
#include "dynamics/held_object.h"
#include "environment/known_robots.h"
#include "environment/repeated_values.h"
#include "environment/robot_range.h"
#include "geometry/scene.h"

namespace robosim {

/// A robot subject to move authorisation: an upright disc.
struct Mover {
  double radius_m = 0;
  HeightSpan heights;
  bool operator==(const Mover&) const = default;
};

/// Authorises moves: decides how far each robot may go in a step (the rule is in environment.h). A robot that holds an
/// object counts as two discs, which stop together. Calls in order: begin(), clip() for all robots, judge() for all,
/// conclude(). Reuses its working memory between steps. `scene` is
/// frozen at the robots' current poses, and `paths` holds all robots' paths in each call. If only some robots are
/// known, the scene has only those; clip() and judge() are then called for robots near which all others are known.
class MoveAuthorisation {
 public:
  MoveAuthorisation(const std::vector<Mover>& movers, const Bounds2D& surface);

  /// Starts a step in which no robot is known to stay.
  /// @param held what robots hold in the step, in ascending order of robots
  void begin(const ParallelExecutor& workers, const KnownRobots& known, std::span<const Path> paths,
             std::span<const HeldObject> held);
  /// Rule (a): clips the paths of some robots at their first contact. The result is Path::end_fraction, which may also
  /// come from another process.
  void clip(const Scene& scene, const ParallelExecutor& workers, RobotRange range, std::span<Path> paths);
  /// Rule (b): decides which of some robots stay where they started.
  void judge(const Scene& scene, const ParallelExecutor& workers, RobotRange range, std::span<const Path> paths);
  /// Result of judge(), 1 for a robot that stays. Writable, for results of another process.
  std::span<std::uint8_t> stays() { return stays_; }
  /// Sets the end of the path of each robot that stays to 0.
  /// @param stalled set to 1 for each robot whose path was clipped or that stays
  void conclude(const ParallelExecutor& workers, const KnownRobots& known, std::span<Path> paths,
                std::span<std::uint8_t> stalled);

 private:
  /// Clips the path of a robot at the first contact of what it holds.
  void clipHeld(const Scene& scene, const HeldObject& held, std::span<Path> paths);
  /// Clips the path of one of a robot's discs at its first contact with what stands.
  /// @param owner the disc's body in the scene
  void clip(const Scene& scene, std::size_t robot, const Mover& disc, BodyId owner, std::span<const Path> paths,
            Path& path);
  /// The robots that could collide with a robot in this step, and the robot itself. Valid until the thread's next call.
  std::span<const std::uint32_t> robotsNear(const Scene& scene, std::size_t robot, const Path& path) const;
  bool collidesWithAnother(const Scene& scene, std::size_t robot, std::span<const Path> paths) const;
  bool collide(std::size_t robot, std::size_t other, std::span<const Path> paths) const;
  /// Of all discs of a robot from its centre.
  double extentOf(std::size_t robot) const;

  RepeatedValues<Mover> movers_;
  Bounds2D surface_;
  std::vector<HeldObject> held_;
  double radius_max_m_ = 0;
  double extent_max_m_ = 0;                        ///< in this step
  double length_max_m_ = 0;                        ///< longest path of this step
  std::vector<std::uint8_t> may_have_neighbours_;  ///< 0: robotsNear() found no other robot
  std::vector<std::uint8_t> stays_;
};

}  // namespace robosim
