#include "robosim/remote_map.h"

#include <exception>
#include <utility>

namespace robosim {
namespace {

/// How long after a failure the environment is called again.
constexpr std::chrono::seconds kPause{1};

std::shared_ptr<const MapWorld> mapOf(const Sight& sight) {
  auto map = std::make_shared<MapWorld>();
  const World& world = sight.world.world;
  map->name = world.name;
  map->x_min_m = world.bounds.x_min;
  map->x_max_m = world.bounds.x_max;
  map->y_min_m = world.bounds.y_min;
  map->y_max_m = world.bounds.y_max;
  for (const auto& object : world.objects) {
    MapWorld::Thing thing;
    thing.world_from_thing = object.body.world_from_body;
    if (const auto* cube = std::get_if<Cube>(&object.body.shape)) {
      thing.length_m = cube->length_m;
      thing.width_m = cube->width_m;
    } else {
      thing.radius_m = object.body.coveringRadius();
    }
    thing.color = object.body.color;
    thing.is_hot = object.body.heat_celsius != 0;
    map->things.push_back(thing);
  }
  for (const auto& robot : sight.world.fleet.robots) {
    map->robots.push_back({robot.info.name, robot.info.radius_m, robot.body.color});
  }
  return map;
}

}  // namespace

ViewerMap::ViewerMap(DialOptions environment) : environment_(std::move(environment)), thread_([this] { work(); }) {}

ViewerMap::~ViewerMap() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    if (viewer_) viewer_->leave();
  }
  bell_.notify_all();
  thread_.join();
}

void ViewerMap::want(bool wanted) {
  const std::lock_guard lock(mutex_);
  is_wanted_ = wanted;
  if (viewer_ && !wanted) viewer_->leave();
  bell_.notify_all();
}

std::shared_ptr<const MapView> ViewerMap::newest() {
  const std::lock_guard lock(mutex_);
  return view_;
}

void ViewerMap::work() {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      bell_.wait(lock, [this] { return is_wanted_ || is_over_; });
      if (is_over_) return;
    }
    try {
      watch();
    } catch (const std::exception& error) {
      complain(error.what());
    }
    std::unique_lock lock(mutex_);
    bell_.wait_for(lock, kPause, [this] { return is_over_; });
  }
}

void ViewerMap::watch() {
  Viewer viewer(environment_);
  {
    const std::lock_guard lock(mutex_);
    if (!is_wanted_ || is_over_) return;
    viewer_ = &viewer;
  }
  const auto forget = [this] {
    const std::lock_guard lock(mutex_);
    viewer_ = nullptr;
  };
  try {
    show(viewer.sight(), true);
    while (viewer.look()) show(viewer.sight(), viewer.isOtherWorld());
  } catch (...) {
    forget();
    throw;
  }
  forget();
}

void ViewerMap::show(const Sight& sight, bool is_other_world) {
  auto view = std::make_shared<MapView>();
  view->world = is_other_world ? mapOf(sight) : newest()->world;
  view->step = sight.step;
  for (const auto& robot : sight.robots) {
    view->world_from_robot.push_back(robot.world_from_robot);
    view->activity.push_back(robot.activity);
  }
  const std::lock_guard lock(mutex_);
  view_ = std::move(view);
}

void ViewerMap::complain(const std::string& problem) {
  auto view = std::make_shared<MapView>();
  view->problem = problem;
  const std::lock_guard lock(mutex_);
  view_ = std::move(view);
}

}  // namespace robosim
