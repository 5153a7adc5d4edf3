#pragma once
#include <string>
#include <utility>
#include <vector>

#include "dynamics/object_mover.h"

namespace robosim {

/// Objects, robots and walls without an environment. Robots drive where their speeds lead them, without any check among
/// themselves.
struct ObjectWorld {
  explicit ObjectWorld(const Bounds2D& the_surface = {-10, 10, -10, 10}) : surface(the_surface) {}

  /// A box of 0.1 m across that is closed at a place.
  std::size_t addDoor(const mrpt::math::TPose2D& closed, double length_m, Door door) {
    door.world_from_closed = closed;
    const Body body{.shape = Cube{length_m, 0.1}, .world_from_body = closed, .center_z_m = 0.25, .height_m = 0.5};
    bodies.push_back(MovableBody::from({.name = "", .body = body, .door = door, .line = {}}));
    objects.push_back({{}, bodies.back().doorAt(door.share), door.open_to, door.share, {}});
    return objects.size() - 1;
  }
  /// @return its index
  std::size_t addBox(const mrpt::math::TPose2D& at, double length_m, double width_m, const Movable& movable = {}) {
    return add({.shape = Cube{length_m, width_m}, .world_from_body = at, .center_z_m = 0.25, .height_m = 0.5}, movable);
  }
  std::size_t addDisc(const mrpt::math::TPose2D& at, double radius_m, const Movable& movable = {}) {
    return add({.shape = Cylinder{radius_m}, .world_from_body = at, .center_z_m = 0.25, .height_m = 0.5}, movable);
  }
  /// A person of 0.25 m radius, whose home is where it is.
  std::size_t addWalker(const mrpt::math::TPoint2D& at, Walker walker, const std::string& name = "walker") {
    walker.home = at;
    const Body body{.shape = Cylinder{0.25}, .world_from_body = {at.x, at.y, 0}, .center_z_m = 0.85, .height_m = 1.7};
    bodies.push_back(MovableBody::from({.name = name, .body = body, .walker = std::move(walker), .line = {}}));
    objects.push_back({{}, body.world_from_body});
    return objects.size() - 1;
  }
  void addConveyor(const mrpt::math::TPose2D& at, double length_m, double width_m, double speed_mps) {
    const Body body{.shape = Cube{length_m, width_m}, .world_from_body = at, .center_z_m = -0.05, .height_m = 0.1};
    belts.push_back(Belt::from({.name = "", .body = body, .conveyor = Conveyor{speed_mps}, .line = {}}));
  }
  std::size_t addRobot(const mrpt::math::TPose2D& at, double speed_mps, double push_max_n = 1000,
                       double radius_m = 0.25) {
    robots.push_back({radius_m, {0, 0.5}, push_max_n});
    poses.push_back(at);
    speeds_mps.push_back(speed_mps);
    is_blocked.push_back(0);
    return robots.size() - 1;
  }
  void addWall(const mrpt::math::TPose2D& at, double length_m, double width_m) {
    walls.push_back({OrientedBox::from(at, length_m, width_m), {0, 1}});
  }

  /// The solids at present, indexed: the walls, then the robots and the objects.
  Scene scene() const;
  /// A step of all.
  void step(double period_s = 0.1, int threads = 1);
  void run(double duration_s, double period_s = 0.1);

  Outline outlineOf(std::size_t object) const { return bodies[object].outlineAt(objects[object].world_from_object); }
  const mrpt::math::TPose2D& at(std::size_t object) const { return objects[object].world_from_object; }
  /// Of all objects, in the length and turn in which friction and inertia are equal in all directions [J].
  double energy() const;
  /// The deepest overlap of any two bodies, or of one with the outside of the surface [m]; 0 if none overlap. By brute
  /// force, for boxes by the least distance by which a shift along a side separates them.
  double deepestOverlap() const;

  Bounds2D surface;
  std::vector<MovableBody> bodies;
  std::vector<Belt> belts;
  std::vector<ObjectMotion> objects;
  std::vector<PushingDisc> robots;
  std::vector<mrpt::math::TPose2D> poses;  ///< of the robots
  std::vector<double> speeds_mps, turns_radps;
  std::vector<std::uint8_t> is_blocked;  ///< in the last step
  std::vector<Solid> walls;

 private:
  std::size_t add(const Body& body, const Movable& movable) {
    bodies.push_back(MovableBody::from({.name = "", .body = body, .movable = movable, .line = {}}));
    objects.push_back({{}, body.world_from_body});
    return objects.size() - 1;
  }
};

}  // namespace robosim
