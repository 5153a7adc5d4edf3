#include "environment/placed_bodies.h"

#include <algorithm>
#include <array>

namespace robosim {

PlacedBodies::PlacedBodies(const Model& model, const std::vector<WorldObject>& objects)
    : model_(&model),
      scene_(model.stationary, 0),
      frames_(model.fleet.robots.size()),
      floor_pictures_(floorPicturesOf(model.world.maps)),
      georeference_(georeferenceOf(model.world)) {
  std::vector<CompactBody> robot_bodies;
  robot_bodies.reserve(model.fleet.robots.size());
  for (const auto& robot : model.fleet.robots) {
    robot_bodies.push_back(compact(robot));
    if (!std::holds_alternative<Cylinder>(robot_bodies.back().shape))
      beyond_body_m_ = std::max(beyond_body_m_, robot.info.radius_m);
  }
  robot_bodies_ = RepeatedValues(robot_bodies);
  setObjects(objects);
}

PlacedBodies::CompactBody PlacedBodies::compact(const FleetRobot& robot) {
  const Body body = robot.body();
  return {body.shape, body.heights()};
}

void PlacedBodies::setObjects(const std::vector<WorldObject>& objects) {
  listObjects(objects);
  heat_sources_.clear();
  reflectivity_.clear();
  featured_.clear();
  addProperties(objects);
  if (BodyLooks::areSeen(*model_)) {
    looks_ = BodyLooks(*model_, objects, scene_, body_of_object_, floor_pictures_);
  }
}

void PlacedBodies::listObjects(const std::vector<WorldObject>& objects) {
  movable_.clear();
  for (const auto& object : objects) {
    if (!object.isStationary()) movable_.push_back(MovableBody::from(object));
  }
  const std::size_t robots = model_->fleet.robots.size();
  // Otherwise interventions have changed some, and the run has a list of its own.
  const bool are_of_world = &objects == &model_->world.objects;
  scene_ = Scene(are_of_world ? model_->stationary
                              : indexStationary(stationarySolids(objects, model_->world.maps), model_->world.bounds),
                 robots + movable_.size());
  body_of_object_.clear();
  std::uint32_t stationary = 0;
  std::size_t moving = robots;
  for (const auto& object : objects) {
    body_of_object_.push_back(object.isStationary() ? BodyId{stationary++} : scene_.movingBody(moving++));
  }
}

std::optional<std::size_t> PlacedBodies::objectOf(BodyId body) const {
  const auto found = std::find(body_of_object_.begin(), body_of_object_.end(), body);
  if (found == body_of_object_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - body_of_object_.begin());
}

bool PlacedBodies::isRobot(BodyId body) const {
  const auto i = static_cast<std::size_t>(body);
  return i >= scene_.stationaryCount() && scene_.movingIndex(body) < robot_bodies_.size();
}

void PlacedBodies::addProperties(const std::vector<WorldObject>& objects) {
  const auto& robots = model_->fleet.robots;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const BodyId id = body_of_object_[i];
    const auto& pose = objects[i].body.world_from_body;
    addHeatSource(objects[i].body, {pose.x, pose.y}, id);
    addReflectivity(objects[i].body, id);
    addFeatures(objects[i].body, id);
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Body body = robots[i].body();
    addHeatSource(body, {}, scene_.movingBody(i));
    addReflectivity(body, scene_.movingBody(i));
    addFeatures(body, scene_.movingBody(i));
  }
}

void PlacedBodies::addHeatSource(const Body& body, const mrpt::math::TPoint2D& center, BodyId id) {
  if (body.heat_celsius != 0) heat_sources_.push_back({center, body.heat_celsius, id});
}

void PlacedBodies::addReflectivity(const Body& body, BodyId id) {
  if (body.reflectivity == kReflectivity) return;
  reflectivity_.resize(scene_.stationaryCount() + scene_.movingCount(), static_cast<float>(kReflectivity));
  reflectivity_[static_cast<std::size_t>(id)] = static_cast<float>(body.reflectivity);
}

void PlacedBodies::addFeatures(const Body& body, BodyId id) {
  if (FeaturedBody::isOne(body)) featured_.push_back({body, body.solid(), id});
}

void PlacedBodies::placeFeatured(const State& state, std::span<const ObjectMotion> motions, const KnownRobots& known) {
  for (FeaturedBody& one : featured_) {
    if (static_cast<std::size_t>(one.id) < scene_.stationaryCount()) continue;
    const std::size_t i = scene_.movingIndex(one.id);
    if (i < robot_bodies_.size()) {
      const auto some = known.some();
      const bool is_known = known.areAll() || std::binary_search(some.begin(), some.end(), i);
      one.is_present = is_known && !state.isAbsent(i);
      one.body.world_from_body = state.world_from_robot[i];
    } else {
      one.body.world_from_body = motions[i - robot_bodies_.size()].world_from_object;
    }
    one.solid = one.body.solid();
  }
}

void PlacedBodies::place(const State& state, std::span<const ObjectMotion> motions, const KnownRobots& known,
                         RobotRange kept, const ParallelExecutor& workers) {
  for (std::size_t k = 0; k < motions.size(); ++k) {
    scene_.place(robot_bodies_.size() + k, {movable_[k].outlineAt(motions[k].world_from_object), movable_[k].heights});
  }
  known.forChunks(workers, kRobotChunk, [&](const auto& order, std::size_t begin, std::size_t end) {
    std::array<double, kRobotChunk> heading_rad, sin, cos;
    const std::size_t count = end - begin;
    for (std::size_t k = 0; k < count; ++k) heading_rad[k] = state.world_from_robot[order[begin + k]].phi;
    portable::sincos({heading_rad.data(), count}, sin.data(), cos.data());
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = order[begin + k];
      if (state.isAbsent(i)) {
        scene_.remove(i);
        continue;
      }
      const auto& pose = state.world_from_robot[i];
      const CompactBody& body = robot_bodies_[i];
      const portable::SinCos heading{sin[k], cos[k]};
      if (kept.contains(i)) frames_[i] = PlanarTransform(pose, body.heights.z_min_m, heading);
      scene_.place(i, body.solidAt(pose, heading));
    }
  });
  if (known.areAll()) {
    scene_.freeze(workers);
  } else {
    scene_.freeze(workers, known.some());
  }
  if (!featured_.empty()) placeFeatured(state, motions, known);
  if (!looks_.isEmpty()) looks_.setLeds(state, known, workers);
  for (auto& source : heat_sources_) {
    if (static_cast<std::size_t>(source.body) < scene_.stationaryCount()) continue;
    const std::size_t robot = scene_.movingIndex(source.body);
    if (robot >= robot_bodies_.size()) {
      const auto& pose = motions[robot - robot_bodies_.size()].world_from_object;
      source.center = {pose.x, pose.y};
      continue;
    }
    const auto& pose = state.world_from_robot[robot];
    source.center = {pose.x, pose.y};
    source.heat_celsius = state.isAbsent(robot) ? 0 : model_->fleet.robots[robot].body().heat_celsius;
  }
}

Solid PlacedBodies::CompactBody::solidAt(const mrpt::math::TPose2D& world_from_robot,
                                         const portable::SinCos& heading) const {
  const mrpt::math::TPoint2D center{world_from_robot.x, world_from_robot.y};
  if (const auto* const cylinder = std::get_if<Cylinder>(&shape)) return {Circle{center, cylinder->radius_m}, heights};
  const Cube& cube = std::get<Cube>(shape);
  return {OrientedBox{center, {heading.cos, heading.sin}, cube.length_m / 2, cube.width_m / 2}, heights};
}

Solid PlacedBodies::discOf(std::size_t robot, const mrpt::math::TPoint2D& center) const {
  return {Circle{center, model_->fleet.robots[robot].info.radius_m}, robot_bodies_[robot].heights};
}

BodyId PlacedBodies::overlapped(const Solid& solid, BodyId except, Among among) const {
  const auto as_obstacle = [&](BodyId body) {
    Solid obstacle = scene_.solid(body);
    const auto* box = std::get_if<OrientedBox>(&obstacle.outline);
    if (!box || !isRobot(body)) return obstacle;
    return discOf(scene_.movingIndex(body), box->center);
  };
  std::vector<BodyId> near;
  Bounds2D area = boundsOf(solid.outline);
  area = {area.x_min - beyond_body_m_, area.x_max + beyond_body_m_, area.y_min - beyond_body_m_,
          area.y_max + beyond_body_m_};
  scene_.findBodies(area, near);
  const std::size_t first = among == Among::moving ? scene_.stationaryCount() : 0;
  const auto found = std::find_if(near.begin(), near.end(), [&](BodyId body) {
    return static_cast<std::size_t>(body) >= first && body != except && overlap(solid, as_obstacle(body));
  });
  return found == near.end() ? kNoBody : *found;
}

Snapshot PlacedBodies::snapshot(const State& state, std::span<const Path> paths, ImageSource* images) const {
  return {.scene = scene_,
          .heat_sources = heat_sources_,
          .world_from_robot = state.world_from_robot,
          .frames = frames_,
          .last_motion = state.last_motion,
          .laser_pan_rad = state.laser_pan_rad,
          .activity = state.activity,
          .time = state.time,
          .seed = state.seed,
          .images = images,
          .objects = state.objects,
          .surface = model_->world.bounds,
          .paths = paths,
          .driven_m = state.driven_m,
          .reflectivity = reflectivity_,
          .closed_grippers = state.closed_grippers,
          .featured = featured_,
          .floor_pictures = floor_pictures_,
          .commands = state.commands,
          .georeference = georeference_ ? &*georeference_ : nullptr,
          .looks = looks_.looks(),
          .identities = looks_.identities(),
          .floor = looks_.isEmpty() ? nullptr : &looks_.floor()};
}

}  // namespace robosim
