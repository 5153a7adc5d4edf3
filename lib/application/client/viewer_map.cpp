#include "client/viewer_map.h"

#include <exception>
#include <utility>

namespace robosim {
namespace {

/// Delay before reconnecting to the environment after a failure.
constexpr std::chrono::seconds kPause{1};

std::shared_ptr<const MapWorld> mapOf(const ViewedRun& viewed_run) {
  auto map = std::make_shared<MapWorld>();
  const World& world = viewed_run.world.world;
  map->name = world.name;
  map->x_min_m = world.bounds.x_min;
  map->x_max_m = world.bounds.x_max;
  map->y_min_m = world.bounds.y_min;
  map->y_max_m = world.bounds.y_max;
  for (const auto& object : viewed_run.snapshot.objects.orThose(world.objects)) {
    MapWorld::Object mapped;
    mapped.world_from_object = object.body.world_from_body;
    if (const auto* cube = std::get_if<Cube>(&object.body.shape)) {
      mapped.length_m = cube->length_m;
      mapped.width_m = cube->width_m;
    } else {
      mapped.radius_m = object.body.coveringRadius();
    }
    mapped.color = object.body.color;
    mapped.is_hot = object.body.heat_celsius != 0;
    map->objects.push_back(mapped);
  }
  for (const auto& robot : viewed_run.world.fleet.robots) {
    map->robots.push_back({robot.info.name, robot.info.radius_m, robot.color});
  }
  return map;
}

}  // namespace

ViewerMap::ViewerMap(ConnectOptions environment) : environment_(std::move(environment)), thread_([this] { work(); }) {}

ViewerMap::~ViewerMap() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    if (viewer_) viewer_->leave();
  }
  condition_.notify_all();
  thread_.join();
}

void ViewerMap::setWatched(bool is_watched) {
  const std::lock_guard lock(mutex_);
  is_watched_ = is_watched;
  if (viewer_ && !is_watched) viewer_->leave();
  condition_.notify_all();
}

std::shared_ptr<const MapView> ViewerMap::newest() {
  const std::lock_guard lock(mutex_);
  return view_;
}

void ViewerMap::work() {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      condition_.wait(lock, [this] { return is_watched_ || is_over_; });
      if (is_over_) return;
    }
    try {
      receive();
    } catch (const std::exception& error) {
      showProblem(error.what());
    }
    std::unique_lock lock(mutex_);
    condition_.wait_for(lock, kPause, [this] { return is_over_; });
  }
}

void ViewerMap::receive() {
  Viewer viewer(environment_);
  {
    const std::lock_guard lock(mutex_);
    if (!is_watched_ || is_over_) return;
    viewer_ = &viewer;
  }
  const auto disconnect = [this] {
    const std::lock_guard lock(mutex_);
    viewer_ = nullptr;
  };
  try {
    show(viewer.run(), true);
    while (viewer.waitForFrame()) show(viewer.run(), viewer.isNewWorld());
  } catch (...) {
    disconnect();
    throw;
  }
  disconnect();
}

void ViewerMap::show(const ViewedRun& viewed_run, bool is_other_world) {
  auto view = std::make_shared<MapView>();
  if (is_other_world) {
    view->world = mapOf(viewed_run);
    map_objects_ = shown_objects_ = viewed_run.snapshot.objects;
  } else {
    placeObjects(viewed_run, *view);
  }
  view->step = viewed_run.snapshot.step;
  for (const auto& robot : viewed_run.snapshot.robots) {
    view->world_from_robot.push_back(robot.world_from_robot);
    view->activity.push_back(robot.activity);
  }
  const std::lock_guard lock(mutex_);
  view_ = std::move(view);
}

/// Sets the world and the places of its objects from those of the newest view. A world whose objects are others, in
/// more than their places, is another one.
void ViewerMap::placeObjects(const ViewedRun& viewed_run, MapView& view) {
  const auto before = newest();
  const ChangedObjects& now = viewed_run.snapshot.objects;
  view.world = before->world;
  view.world_from_object = before->world_from_object;
  if (now.isSameList(shown_objects_)) return;
  shown_objects_ = now;
  const auto& of_world = viewed_run.world.world.objects;
  const auto moved = movedBetween(map_objects_.orThose(of_world), now.orThose(of_world));
  if (!moved) {
    view.world = mapOf(viewed_run);
    view.world_from_object.reset();
    map_objects_ = now;
    return;
  }
  auto places = std::make_shared<std::vector<mrpt::math::TPose2D>>();
  for (const auto& object : now.orThose(of_world)) places->push_back(object.body.world_from_body);
  view.world_from_object = std::move(places);
}

void ViewerMap::showProblem(const std::string& problem) {
  auto view = std::make_shared<MapView>();
  view->problem = problem;
  const std::lock_guard lock(mutex_);
  view_ = std::move(view);
}

}  // namespace robosim
