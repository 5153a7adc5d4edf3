#include "environment/model.h"

#include <string>

#include "base/digest.h"

namespace robosim {
namespace {

void add(Digest& digest, const std::string& text) {
  digest.add(text.size());
  digest.addBytes(text.data(), text.size());
}

void add(Digest& digest, const mrpt::math::TPose2D& pose) {
  for (const double value : {pose.x, pose.y, pose.phi}) digest.add(value);
}

void add(Digest& digest, const Body& body) {
  digest.add(body.shape.index());
  if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
    digest.add(cylinder->radius_m);
  } else {
    const Cube& cube = std::get<Cube>(body.shape);
    digest.add(cube.length_m);
    digest.add(cube.width_m);
  }
  add(digest, body.world_from_body);
  for (const double value : {body.center_z_m, body.height_m, body.heat_celsius, body.reflectivity}) digest.add(value);
  for (const float value : body.color) digest.add(value);
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

void add(Digest& digest, const World& world) {
  const Bounds2D& bounds = world.bounds;
  for (const double value :
       {world.unit_m, bounds.x_min, bounds.x_max, bounds.y_min, bounds.y_max, world.communication.range_m.value_or(-1),
        world.communication.loss_probability, world.win_distance_m}) {
    digest.add(value);
  }
  const Communication& c = world.communication;
  for (const double value :
       {c.wall_range_m, c.wall_loss, c.burst_gap_s, c.burst_s, c.burst_loss, c.delay_s, c.rate_hz}) {
    digest.add(value);
  }
  digest.add(world.objects.size());
  for (const auto& object : world.objects) add(digest, object.body);
  for (const auto& solid : stationarySolids(world)) add(digest, solid);
}

void add(Digest& digest, const FleetRobot& robot) {
  add(digest, robot.info.name);
  add(digest, robot.world_from_start);
  add(digest, robot.body);
  const MotionLimits& limits = robot.info.limits;
  for (const double value : {robot.info.radius_m, limits.speed_max_mps, limits.turn_max_radps, limits.accel_mps2,
                             limits.decel_mps2, limits.turn_accel_radps2}) {
    digest.add(value);
  }
  digest.add(robot.model->sensors_digest);
  digest.add(robot.info.sensors->size());
  for (const auto& sensor : *robot.info.sensors) {
    add(digest, nameOf(sensor.kind));
    add(digest, sensor.label);
    digest.add(sensor.beams.size());
  }
}

}  // namespace

std::uint64_t digestOf(const Model& model) {
  Digest digest;
  digest.add(model.seed);
  digest.add(model.period_s);
  add(digest, model.world);
  digest.add(model.fleet.robots.size());
  for (const auto& robot : model.fleet.robots) add(digest, robot);
  return digest.value();
}

}  // namespace robosim
