#include "sensors/testing/featured_scene.h"

#include <algorithm>

namespace robosim {
namespace {

Solid discOf(const mrpt::math::TPose2D& robot) { return {Circle{{robot.x, robot.y}, 0.2}, {0, 0.3}}; }

}  // namespace

std::vector<double> FeaturedScene::values(const Sensor& sensor) {
  commands.resize(robots.size());
  std::vector<Solid> solids;
  for (const Body& body : objects) solids.push_back(body.solid());
  Scene scene(solids, robots.size(), {-20, 20, -20, 20});
  std::vector<PlanarTransform> frames;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    scene.place(i, discOf(robots[i]));
    frames.emplace_back(robots[i], 0);
  }
  scene.freeze();
  std::vector<FeaturedBody> featured;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (FeaturedBody::isOne(objects[i])) {
      featured.push_back({objects[i], solids[i], BodyId{static_cast<std::uint32_t>(i)}});
    }
  }
  const std::vector<Motion> motions(robots.size());
  const std::vector<float> pans(robots.size());
  SimTime time;
  time.step = step;
  const Snapshot now{.scene = scene,
                     .heat_sources = {},
                     .world_from_robot = robots,
                     .frames = frames,
                     .last_motion = motions,
                     .laser_pan_rad = pans,
                     .time = time,
                     .seed = 1,
                     .featured = featured,
                     .floor_pictures = pictures,
                     .commands = commands};
  std::vector<Readings> readings(1);
  readings[0].measurements.push_back(sensor.blank());
  const std::uint32_t robot = 0;
  sensor.sense(now, {&robot, 1}, 0, readings);
  return std::get<Values>(readings[0].measurements[0]).values;
}

Body pillarBody(double x_m, double y_m, double radius_m, double z_min_m, double z_max_m) {
  Body body;
  body.shape = Cylinder{radius_m};
  body.world_from_body = {x_m, y_m, 0};
  body.center_z_m = (z_min_m + z_max_m) / 2;
  body.height_m = z_max_m - z_min_m;
  return body;
}

Body boxBody(const mrpt::math::TPose2D& pose, double length_m, double width_m, double z_min_m, double z_max_m) {
  Body body = pillarBody(pose.x, pose.y, 1, z_min_m, z_max_m);
  body.shape = Cube{length_m, width_m};
  body.world_from_body = pose;
  return body;
}

Body coloured(Body body, const std::array<float, 3>& rgb) {
  body.color = rgb;
  return body;
}

Body lampAt(const mrpt::math::TPoint3D& at, double light_cd) {
  Body body = pillarBody(at.x, at.y, 0.01, at.z - 0.01, at.z + 0.01);
  body.light_cd = light_cd;
  return body;
}

bool isFreeByHand(const FeaturedScene& scene, const mrpt::math::TPoint3D& from, const mrpt::math::TPoint3D& to,
                  const Body* seen, std::size_t robot) {
  const auto way = to - from;
  const double distance_m = way.norm();
  const Ray ray{from, way * (1 / distance_m)};
  double reach_m = distance_m;
  const auto meet = [&](const Solid& solid) { return intersect(ray, solid).value_or(distance_m); };
  if (seen) reach_m = std::min(reach_m, meet(seen->solid()));
  if (robot > 0) reach_m = std::min(reach_m, meet(discOf(scene.robots[robot])));
  const auto blocks = [&](const Solid& solid) { return meet(solid) < reach_m; };
  for (const Body& body : scene.objects) {
    if (&body != seen && blocks(body.solid())) return false;
  }
  for (std::size_t i = 1; i < scene.robots.size(); ++i) {
    if (i != robot && blocks(discOf(scene.robots[i]))) return false;
  }
  return true;
}

}  // namespace robosim
