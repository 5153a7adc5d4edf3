#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dynamics/contact.h"
#include "dynamics/driven_plans.h"
#include "dynamics/movable_body.h"
#include "geometry/shapes/path.h"

namespace robosim {

/// Objects and robots of which each may touch another in a time step, and the stationary solids near the objects. The
/// references must remain valid.
struct PushingGroup {
  struct Object {
    const MovableBody* body;
    ObjectMotion* motion;
    const DrivenPlan* plan = nullptr;  ///< of a driven body
  };
  struct Robot {
    const PushingDisc* disc;
    Path* path;  ///< authorised; its end_fraction is reduced where the robot is blocked
    /// Index of the other disc of a robot that holds an object: the two stop together.
    std::optional<std::uint32_t> partner = {};
  };
  /// Bodies that may touch. The first is an object; or both are robots.
  struct Pair {
    enum class With : std::uint8_t { object, robot, stationary, two_robots };
    With with;
    std::uint32_t first, second;  ///< into `objects`, `robots` or `stationary`
  };
  std::vector<Object> objects;
  std::vector<Robot> robots;
  std::vector<Outline> stationary;
  std::span<const Belt> belts;
  std::vector<Pair> pairs;   ///< their order affects rounding only
  double reach_m = 0;        ///< no object may move farther in the step
  double speed_max_mps = 0;  ///< no object may be faster
};

/// Moves the objects of a group, and stops its robots where they are blocked, for a time step (doc/moving_objects.md).
/// No two of its bodies overlap afterwards if none did before. Doors and walkers move evenly, as if their mass were
/// infinite, and are blocked for the rest of the step like robots, by robots and by what is wedged.
///
/// The step is divided into equal parts, in which the robots drive on along their paths. In each part, bodies that may
/// touch form islands, each of which is computed alone:
///  1. friction decelerates each object, relative to the belt on which it stands;
///  2. bodies that touch and approach each other exchange impulses along the normal of their contact, without friction:
///     first those that bounce, then all until none approach (Catto, "Iterative dynamics with temporal coherence",
///     2005). Robots and stationary solids do not give way;
///  3. the objects move on, and are shifted until nothing is nearer than kContactGap_m, by the shortest way in (x, y,
///     turn_radius · turn), which is the motion of least friction under the limit surface;
///  4. robots whose objects in contact need more work against friction than `push_max_n` times the distance that the
///     robots drive are blocked for the rest of the step, and the part is repeated;
///  5. if bodies overlap nevertheless, because objects are wedged, the part is halved, up to kHalvings times. Then
///  robots
///     and objects that push each other there stay where they are.
class Pushing {
 public:
  /// Longest part of a step [s].
  static constexpr double kPart_s = 0.01;
  /// A jammed robot stops at most its speed times kPart_s / 2^kHalvings before the contact.
  static constexpr int kHalvings = 6;
  /// Two bodies bounce when they approach faster than this [m/s].
  static constexpr double kBounceMin_mps = 0.05;

  /// @param period_s length of the step
  static void move(PushingGroup& group, double period_s);
};

}  // namespace robosim
