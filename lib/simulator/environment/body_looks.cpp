#include "environment/body_looks.h"

#include <algorithm>

#include "hardware/led_color.h"
#include "hardware/raw_picture.h"

namespace robosim {
namespace {

Rgb levelsOf(std::uint32_t color) {
  return {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8),
          static_cast<std::uint8_t>(color)};
}
Rgb levelsOf(const std::array<float, 3>& color) { return levelsOf(ledColor(color)); }

SurfaceLook lookOf(const Body& body) { return {levelsOf(body.color), body.heat_celsius > 0 || body.light_cd > 0}; }

}  // namespace

bool BodyLooks::areSeen(const Model& model) {
  return std::any_of(model.fleet.robots.begin(), model.fleet.robots.end(), [](const FleetRobot& robot) {
    return std::any_of(robot.info.sensors->begin(), robot.info.sensors->end(),
                       [](const SensorInfo& sensor) { return sensor.camera.isRaycast(); });
  });
}

BodyLooks::BodyLooks(const Model& model, const std::vector<WorldObject>& objects, const Scene& scene,
                     const std::vector<BodyId>& body_of_object, std::span<const FloorPicture> floor_pictures)
    : floor_{model.world.bounds, {}, floor_pictures}, first_robot_(scene.stationaryCount()) {
  const std::size_t bodies = scene.stationaryCount() + scene.movingCount();
  looks_.resize(bodies);
  identities_.resize(bodies, RawPicture::kWall);
  std::size_t next = 0;  // the first stationary body that is no object
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto body = static_cast<std::size_t>(body_of_object[i]);
    looks_[body] = lookOf(objects[i].body);
    identities_[body] = static_cast<std::uint32_t>(i);
    if (objects[i].isStationary()) ++next;
    if (objects[i].body.isFloor()) floor_.areas.push_back({objects[i].body.solid().outline, looks_[body].color});
  }
  for (const WorldMap& map : model.world.maps) {
    if (map.isFloor()) continue;
    std::vector<Solid> solids;
    addSolids(map.plan, map.world_from_map, map.heights(), solids);
    std::fill_n(looks_.begin() + static_cast<std::ptrdiff_t>(next), solids.size(), SurfaceLook{levelsOf(map.color)});
    next += solids.size();
  }
  for (std::size_t i = 0; i < model.fleet.robots.size(); ++i) {
    // A robot that is hot is seen as it is: only what is sought glows.
    robots_.push_back({levelsOf(model.fleet.robots[i].color)});
    looks_[first_robot_ + i] = robots_.back();
    identities_[first_robot_ + i] = static_cast<std::uint32_t>(objects.size() + i);
  }
}

void BodyLooks::setLeds(const State& state, const KnownRobots& known, const ParallelExecutor& workers) {
  constexpr std::size_t kRobotsPerChunk = 256;
  known.forEach(workers, kRobotsPerChunk, [&](std::size_t i) {
    const std::uint32_t led = state.commands[i].led_color;
    looks_[first_robot_ + i] = led == 0 ? robots_[i] : SurfaceLook{levelsOf(led), true};
  });
}

}  // namespace robosim
