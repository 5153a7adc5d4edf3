#include "world/body.h"

#include <cmath>

#include "base/digest.h"
#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "base/random.h"

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

mrpt::math::TPose2D Door::poseAt(double at_share, double length_m) const {
  if (turn_rad == 0) return portable::compose(world_from_closed, {slide_m * at_share, 0, 0});
  const auto world_from_hinge = portable::compose(world_from_closed, {-length_m / 2, 0, turn_rad * at_share});
  return portable::compose(world_from_hinge, {length_m / 2, 0, 0});
}

double Door::shareRate() const { return speed / std::abs(turn_rad == 0 ? slide_m : turn_rad); }

std::uint32_t Walker::streamOf(const std::string& name) {
  Digest digest;
  digest.addBytes(name.data(), name.size());
  return static_cast<std::uint32_t>(digest.value());
}

mrpt::math::TPoint2D Walker::targetOf(const Walk& on, std::uint64_t seed, std::uint32_t stream) const {
  if (!route.empty()) return on.leg == route.size() ? home : route[on.leg];
  Rng rng(seed, RandomPurpose::walker, stream, 0, on.leg);
  // The root spreads the places evenly over the disc.
  const double way_m = wanders_within_m * std::sqrt(rng.uniform());
  const auto [sin, cos] = portable::sincos(rng.uniform(-M_PI, M_PI));
  return {home.x + way_m * cos, home.y + way_m * sin};
}

Walk Walker::nextLeg(Walk on) const {
  const auto places = static_cast<std::uint32_t>(route.size() + 1);
  if (route.empty()) {
    ++on.leg;
  } else {
    on.leg = (on.leg + (on.is_returning ? places - 1 : 1)) % places;
  }
  return on;
}

Walk Walker::turnedBack(Walk on) const {
  if (!route.empty()) on.is_returning = !on.is_returning;
  return nextLeg(on);
}

}  // namespace robosim
