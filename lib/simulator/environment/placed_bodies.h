#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "base/parallel_executor.h"
#include "base/portable_math.h"
#include "dynamics/movable_body.h"
#include "environment/body_looks.h"
#include "environment/known_robots.h"
#include "environment/model.h"
#include "environment/repeated_values.h"
#include "environment/robot_range.h"
#include "environment/state.h"
#include "geometry/scene.h"
#include "sensors/sensor.h"

namespace robosim {

/// The bodies of a model at the poses of a state: their shapes as a Scene, their heat and their reflectivity.
class PlacedBodies {
 public:
  /// @param model must outlive this object
  PlacedBodies(const Model& model, const std::vector<WorldObject>& objects);

  /// Replaces the objects, in time linear in the size of the world. place() must follow.
  void setObjects(const std::vector<WorldObject>& objects);
  /// The movable ones and doors, in their order. The scene's moving solids are the robots, then these.
  const std::vector<MovableBody>& movable() const { return movable_; }

  /// Places the known robots and the movable objects. Absent robots are not in the scene and emit no heat.
  /// @param motions of the movable objects
  /// @param kept robots whose frames sensors need
  void place(const State& state, std::span<const ObjectMotion> motions, const KnownRobots& known, RobotRange kept,
             const ParallelExecutor& workers);

  /// Of a placed state. Users may only update its neighbours.
  Scene& scene() { return scene_; }
  /// The body of an object in the scene, and the object that a body is; nullopt: a wall or a robot.
  BodyId bodyOf(std::size_t object) const { return body_of_object_[object]; }
  std::optional<std::size_t> objectOf(BodyId body) const;
  bool isRobot(BodyId body) const;
  /// The first body but `except` that a solid overlaps; kNoBody for none. Robots count as the discs for which their
  /// moves are authorised.
  enum class Among { all, moving };
  BodyId overlapped(const Solid& solid, BodyId except, Among among = Among::all) const;
  /// What a robot occupies at a place when it is moved there: its disc, at its height.
  Solid discOf(std::size_t robot, const mrpt::math::TPoint2D& center) const;
  /// What sensors perceive. The result refers to this object and to all parameters.
  /// @param state the placed one
  Snapshot snapshot(const State& state, std::span<const Path> paths, ImageSource* images) const;

 private:
  /// What placing needs of a robot's body: to look it up in the fleet would cost a cache miss or more.
  struct CompactBody {
    std::variant<Cylinder, Cube> shape;
    HeightSpan heights;

    /// The body at a pose. @param heading sine and cosine of world_from_robot.phi
    Solid solidAt(const mrpt::math::TPose2D& world_from_robot, const portable::SinCos& heading) const;
    bool operator==(const CompactBody&) const = default;
  };
  static CompactBody compact(const FleetRobot& robot);

  void listObjects(const std::vector<WorldObject>& objects);
  void addProperties(const std::vector<WorldObject>& objects);
  void addHeatSource(const Body& body, const mrpt::math::TPoint2D& center, BodyId id);
  void addReflectivity(const Body& body, BodyId id);
  void addFeatures(const Body& body, BodyId id);
  /// Where the moving ones are.
  void placeFeatured(const State& state, std::span<const ObjectMotion> motions, const KnownRobots& known);

  const Model* model_;
  Scene scene_;
  RepeatedValues<CompactBody> robot_bodies_;
  std::vector<MovableBody> movable_;
  std::vector<BodyId> body_of_object_;
  double beyond_body_m_ = 0;              ///< maximum by which the disc of a robot extends beyond its body
  std::vector<PlanarTransform> frames_;   ///< of the robots whose readings are kept
  std::vector<HeatSource> heat_sources_;  ///< hot objects, then hot robots; those of moving bodies follow them
  std::vector<float> reflectivity_;       ///< by body; empty if all have the default
  std::vector<FeaturedBody> featured_;    ///< objects, then robots
  std::vector<FloorPicture> floor_pictures_;
  BodyLooks looks_;  ///< empty without ray-cast cameras
  std::optional<GeoReference> georeference_;
};

}  // namespace robosim
