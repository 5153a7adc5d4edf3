#include "environment/model.h"

#include <algorithm>
#include <string>

#include "base/digest.h"
#include "robots/added_robot.h"

namespace robosim {
namespace {

void add(Digest& digest, const std::string& text) {
  digest.add(text.size());
  digest.addBytes(text.data(), text.size());
}

void add(Digest& digest, const mrpt::math::TPose2D& pose) {
  for (const double value : {pose.x, pose.y, pose.phi}) digest.add(value);
}

// The following functions name all members of their parameter: a new one does not compile until it is added here, or
// left out because no run depends on it.

void add(Digest& digest, const Body& body) {
  const auto& [shape, world_from_body, center_z_m, height_m, color, heat_celsius, reflectivity, light_cd, fiducial] =
      body;
  digest.add(shape.index());
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    const auto& [radius_m] = *cylinder;
    digest.add(radius_m);
  } else {
    const auto& [length_m, width_m] = std::get<Cube>(shape);
    digest.add(length_m);
    digest.add(width_m);
  }
  add(digest, world_from_body);
  for (const double value : {center_z_m, height_m, heat_celsius, reflectivity}) digest.add(value);
  for (const float value : color) digest.add(value);
  // Nothing is added for most bodies.
  static_assert(kBodyProperties.size() == 2);
  if (light_cd != 0 || fiducial != 0) {
    digest.add(light_cd);
    digest.add(fiducial);
  }
}

void add(Digest& digest, const Solid& solid) {
  digest.add(solid.heights.z_min_m);
  digest.add(solid.heights.z_max_m);
  digest.add(solid.outline.index());
  if (const auto* circle = std::get_if<Circle>(&solid.outline)) {
    for (const double value : {circle->center.x, circle->center.y, circle->radius_m}) digest.add(value);
  } else {
    const OrientedBox& box = std::get<OrientedBox>(solid.outline);
    for (const double value : {box.center.x, box.center.y, box.axis.x, box.axis.y, box.half_length_m, box.half_width_m})
      digest.add(value);
  }
}

void add(Digest& digest, const WorldObject& object) {
  const auto& [name, body, movable, door, walker, conveyor, line] =
      object;  // the name and the place in the file have no effect
  add(digest, body);
  if (door) {
    const auto& [world_from_closed, slide_m, turn_rad, speed, opens_within_m, open_to, share] = *door;
    add(digest, world_from_closed);
    for (const double value : {slide_m, turn_rad, speed, opens_within_m, open_to, share}) digest.add(value);
  }
  if (walker) {
    const auto& [home, route, wanders_within_m, speed_mps, stops_within_m, walk] = *walker;
    digest.add(Walker::streamOf(name));
    for (const double value : {home.x, home.y, wanders_within_m, speed_mps, stops_within_m}) digest.add(value);
    for (const auto& place : route) {
      digest.add(place.x);
      digest.add(place.y);
    }
  }
  if (conveyor) digest.add(conveyor->speed_mps);
  if (!movable) return;
  const auto& [mass_kg, friction, restitution] = *movable;
  for (const double value : {mass_kg, friction, restitution}) digest.add(value);
}

void add(Digest& digest, const World& world) {
  // Without effect on a run: names, the type of the surface, the origin, and the distance of random starts. The robots
  // are in the fleet, which has those of scatters, too, and the starts; of maps, the solids have an effect.
  const auto& [name, surface_type, unit_m, bounds, communication, win_distance_m, start_distance_m, georeference,
               objects, maps, robots, scatters, timeline, origin] = world;
  const auto& [range_m, loss_probability, wall_range_m, wall_loss, burst_gap_s, burst_s, burst_loss, delay_s, rate_hz] =
      communication;
  for (const double value : {unit_m, bounds.x_min, bounds.x_max, bounds.y_min, bounds.y_max, range_m.value_or(-1),
                             loss_probability, win_distance_m}) {
    digest.add(value);
  }
  for (const double value : {wall_range_m, wall_loss, burst_gap_s, burst_s, burst_loss, delay_s, rate_hz}) {
    digest.add(value);
  }
  digest.add(objects.size());
  for (const auto& object : objects) add(digest, object);
  for (const auto& solid : startSolids(world)) add(digest, solid);
  for (const auto& map : maps) {
    if (!map.isFloor()) continue;
    std::vector<Solid> painted;
    addSolids(map.plan, map.world_from_map, map.heights(), painted);
    for (const auto& solid : painted) add(digest, solid);
    for (const float value : map.color) digest.add(value);
  }
  for (const auto& timed : timeline) {
    digest.add(timed.time_s);
    add(digest, changeText(timed.change));
  }
  // That of a map, too; without one, digests are those of worlds before there were georeferences.
  if (const auto reference = georeferenceOf(world)) {
    const auto& [position, pose] = *reference;
    for (const double value : {position.latitude_deg, position.longitude_deg, position.altitude_m}) digest.add(value);
    add(digest, pose);
  }
}

void add(Digest& digest, const FleetRobot& robot) {
  add(digest, robot.info.name);
  add(digest, robot.world_from_start);
  add(digest, robot.body());
  const MotionLimits& limits = robot.info.type->limits;
  for (const double value : {robot.info.radius_m, limits.speed_max_mps, limits.turn_max_radps, limits.accel_mps2,
                             limits.decel_mps2, limits.turn_accel_radps2, limits.emergency_decel_mps2}) {
    digest.add(value);
  }
  if (const Drive& drive = robot.info.type->drive; drive != Drive()) {
    digest.add(static_cast<std::uint64_t>(drive.kind));
    for (const double value : {limits.lateral_max_mps, drive.wheelbase_m, drive.steering_max_rad,
                               drive.steering_rate_radps, drive.track_factor, drive.assumed_factor, drive.icr_x_m}) {
      digest.add(value);
    }
  }
  digest.add(robot.model->push_max_n);
  digest.add(robot.model->sensors_digest);
  digest.add(robot.info.sensors->size());
  for (const auto& sensor : *robot.info.sensors) {
    add(digest, nameOf(sensor.kind));
    add(digest, sensor.label);
    digest.add(sensor.beams.size());
  }
}

/// @param robots number of the first robots of the fleet that are covered
std::uint64_t digestOfFirst(std::size_t robots, const Model& model) {
  Digest digest;
  digest.add(model.seed);
  digest.add(model.period_s);
  add(digest, model.world);
  digest.add(robots);
  for (std::size_t i = 0; i < robots; ++i) add(digest, model.fleet.robots[i]);
  return digest.value();
}

}  // namespace

std::shared_ptr<const Model> withAdditions(const Model& model, const RobotAdditions& additions) {
  auto other = std::make_shared<Model>(model);
  const auto before = model.additions.list(), after = additions.list();
  const auto differs = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
  auto& robots = other->fleet.robots;
  robots.erase(robots.end() - (before.end() - differs.first), robots.end());
  for (auto added = differs.second; added != after.end(); ++added) {
    other->fleet = withRobot(std::move(other->fleet), *added);
  }
  other->additions = additions;
  return other;
}

std::uint64_t digestOf(const Model& model) { return digestOfFirst(model.fleet.robots.size(), model); }

std::uint64_t digestOfStart(const Model& model) {
  return digestOfFirst(model.fleet.robots.size() - model.additions.size(), model);
}

std::uint64_t digestOf(const FleetRobot& robot) {
  Digest digest;
  add(digest, robot);
  return digest.value();
}

}  // namespace robosim
