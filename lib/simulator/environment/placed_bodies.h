#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel_executor.h"
#include "environment/known_robots.h"
#include "environment/model.h"
#include "environment/robot_range.h"
#include "environment/state.h"
#include "geometry/scene.h"
#include "sensors/sensor.h"

namespace robosim {

/// The bodies of a model at the poses of a state: their shapes as a Scene, their heat and their reflectivity.
class PlacedBodies {
 public:
  explicit PlacedBodies(const Model& model);

  /// Places the known robots. Absent ones are not in the scene and emit no heat.
  /// @param kept robots whose frames sensors need
  void place(const State& state, const KnownRobots& known, RobotRange kept, const ParallelExecutor& workers);

  /// Of a placed state. Users may only update its neighbours.
  Scene& scene() { return scene_; }
  /// Whether a disc at a robot's height is entirely on the surface, and overlaps no body but the robot's own.
  bool isFree(std::size_t robot, const Circle& disc) const;
  /// What sensors perceive. The result refers to this object and to all parameters.
  /// @param state the placed one
  Snapshot snapshot(const State& state, std::span<const Path> paths, ImageSource* images) const;

 private:
  /// What placing needs of a robot's body, in an array: to look it up in the fleet would cost a cache miss or more.
  struct CompactBody {
    std::optional<double> disc_radius_m;  ///< nullopt for a body that is no disc
    HeightSpan heights;
  };

  void addHeatSource(const Body& body, const mrpt::math::TPoint2D& center, BodyId id);
  void addReflectivity(const Body& body, BodyId id);
  Solid solidOf(std::size_t robot, const mrpt::math::TPose2D& world_from_robot) const;

  const Model& model_;
  Scene scene_;
  std::vector<CompactBody> robot_bodies_;
  std::vector<PlanarTransform> frames_;   ///< of the robots whose readings are kept
  std::vector<HeatSource> heat_sources_;  ///< hot objects, then hot robots
  std::vector<float> reflectivity_;       ///< by body; empty if all have the default
};

}  // namespace robosim
