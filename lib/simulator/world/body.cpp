#include "world/body.h"

#include <cmath>

#include "base/portable_math.h"

namespace robosim {

Solid Body::solid() const {
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    return {Circle{{world_from_body.x, world_from_body.y}, cylinder->radius_m}, heights()};
  }
  const auto& cube = std::get<Cube>(shape);
  return {OrientedBox::from(world_from_body, cube.length_m, cube.width_m), heights()};
}

double Body::coveringRadius() const {
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return cylinder->radius_m;
  const auto& cube = std::get<Cube>(shape);
  return portable::hypot(cube.length_m, cube.width_m) / 2;
}

Movable Movable::byVolumeOf(const Body& body) {
  constexpr double kDensity_kgpm3 = 100;
  double area_m2;
  if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
    area_m2 = M_PI * cylinder->radius_m * cylinder->radius_m;
  } else {
    const auto& cube = std::get<Cube>(body.shape);
    area_m2 = cube.length_m * cube.width_m;
  }
  return {.mass_kg = kDensity_kgpm3 * area_m2 * body.height_m};
}

}  // namespace robosim
