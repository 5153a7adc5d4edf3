#include "dynamics/movable_body.h"

#include <algorithm>
#include <limits>

#include "base/portable_math.h"

namespace robosim {
namespace {

constexpr double kGravity_mps2 = 9.81;

/// The part of an integral of the distance over a quarter of a rectangle: over the triangle between its centre and half
/// of the side that lies `ahead` of it.
double distanceIntegral(double ahead, double aside, double diagonal) {
  return (ahead * aside * diagonal + ahead * ahead * ahead * portable::log((diagonal + aside) / ahead)) / 6;
}

}  // namespace

double meanDistance(const std::variant<Cylinder, Cube>& shape) {
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return cylinder->radius_m * 2 / 3;
  const auto& cube = std::get<Cube>(shape);
  const double a = cube.length_m / 2;
  const double b = cube.width_m / 2;
  const double diagonal = portable::hypot(a, b);
  return (distanceIntegral(a, b, diagonal) + distanceIntegral(b, a, diagonal)) / (a * b);
}

MovableBody MovableBody::from(const WorldObject& object) {
  const Body& body = object.body;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Movable movable = object.movable.value_or(Movable{.mass_kg = kInfinity, .friction = 0});
  const auto* cube = std::get_if<Cube>(&body.shape);
  const double covering_m = body.coveringRadius();
  return {.shape = body.shape,
          .heights = body.heights(),
          .mass_kg = movable.mass_kg,
          .friction_n = object.movable ? movable.friction * movable.mass_kg * kGravity_mps2 : 0,
          .restitution = movable.restitution,
          .turn_radius_m = meanDistance(body.shape),
          .covering_radius_m = covering_m,
          .width_min_m = cube ? std::min(cube->length_m, cube->width_m) : 2 * covering_m,
          .door = object.door,
          .walker = object.walker,
          .walker_stream = object.walker ? Walker::streamOf(object.name) : 0};
}

Belt Belt::from(const WorldObject& object) {
  const auto& cube = std::get<Cube>(object.body.shape);
  const OrientedBox area = OrientedBox::from(object.body.world_from_body, cube.length_m, cube.width_m);
  return {area, area.axis * object.conveyor->speed_mps};
}

Outline MovableBody::outlineAt(const mrpt::math::TPose2D& world_from_object) const {
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    return Circle{{world_from_object.x, world_from_object.y}, cylinder->radius_m};
  }
  const auto& cube = std::get<Cube>(shape);
  return OrientedBox::from(world_from_object, cube.length_m, cube.width_m);
}

}  // namespace robosim
