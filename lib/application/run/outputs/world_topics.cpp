#include "run/outputs/world_topics.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <nlohmann/json.hpp>

#include "topics/robot_topics.h"
#include "world/changed_objects.h"
#include "world/raster.h"

namespace robosim {
namespace {

/// Larger grids get larger cells: a map is for display and localisation, and is a message of a byte for each cell.
constexpr double kMaxCells = 4e6;

std::string textOf(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

ros::Marker markerOf(const WorldObject& object, std::size_t id, ros::Time stamp) {
  const Body& body = object.body;
  ros::Marker marker;
  marker.header = {stamp, "map"};
  marker.ns = "objects";
  marker.id = static_cast<std::int32_t>(id);
  marker.pose = poseOf(body.world_from_body);
  marker.pose.position.z = body.center_z_m;
  marker.scale.z = body.height_m;
  if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
    marker.type = ros::Marker::kCylinder;
    marker.scale.x = marker.scale.y = 2 * cylinder->radius_m;
  } else {
    const auto& cube = std::get<Cube>(body.shape);
    marker.type = ros::Marker::kCube;
    marker.scale.x = cube.length_m;
    marker.scale.y = cube.width_m;
  }
  marker.color = {body.color[0], body.color[1], body.color[2], 1};
  marker.text = object.name;
  return marker;
}

}  // namespace

RobotVelocity trueVelocity(const State& state, std::size_t robot) {
  // Not the speeds of the state, which are those it continues with: a robot that a wall has stopped has moved.
  const Motion& motion = state.last_motion[robot];
  const double period_s = state.time.period_s;
  return {motion.length_m / period_s, motion.turn_rad / period_s, motion.lateral_m / period_s};
}

std::vector<RobotVelocity> trueVelocities(const State& state) {
  std::vector<RobotVelocity> all;
  for (std::size_t i = 0; i < state.last_motion.size(); ++i) all.push_back(trueVelocity(state, i));
  return all;
}

TopicMessage WorldTopics::map(std::uint64_t time_ns) const {
  const World& world = model_->world;
  std::vector<HeightSpan> robots;
  for (const auto& robot : model_->fleet.robots) robots.push_back(robot.body().heights());
  MapExtent extent = extentOfMap(world).value_or(MapExtent());
  extent.heights = robotHeights(robots);
  const double area_m2 = (world.bounds.x_max - world.bounds.x_min) * (world.bounds.y_max - world.bounds.y_min);
  extent.cell_m = std::max(extent.cell_m, std::sqrt(area_m2 / kMaxCells));
  ros::OccupancyGrid message;
  message.header = {timeOf(time_ns), "map"};
  message.info.map_load_time = message.header.stamp;
  OccupancyGrid grid;
  try {
    grid = rasterize(world, extent);
  } catch (const ConfigError&) {  // objects far from the surface
    extent.cell_m = kCellMax_m;
    grid = rasterize(world, extent);
  }
  message.info.resolution = static_cast<float>(grid.cell_m);
  message.info.width = grid.columns;
  message.info.height = grid.rows;
  message.info.origin = poseOf(grid.map_from_grid);
  message.data.reserve(grid.cells.size());
  for (const Occupancy cell : grid.cells) {
    message.data.push_back(cell == Occupancy::free ? 0 : cell == Occupancy::occupied ? 100 : -1);
  }
  return topicMessage("/map", TopicDelivery::latched, time_ns, message);
}

/// @param moved indices of the objects whose markers are sent; null: all, instead of all before
TopicMessage WorldTopics::markers(const std::vector<WorldObject>& objects, const std::vector<std::uint32_t>* moved,
                                  std::uint64_t time_ns) const {
  ros::MarkerArray array;
  const ros::Time stamp = timeOf(time_ns);
  if (moved) {
    for (const std::uint32_t i : *moved) array.markers.push_back(markerOf(objects[i], i, stamp));
  } else {
    ros::Marker clear;
    clear.header = {stamp, "map"};
    clear.ns = "objects";
    clear.action = ros::Marker::kDeleteAll;
    array.markers.push_back(clear);
    for (std::size_t i = 0; i < objects.size(); ++i) array.markers.push_back(markerOf(objects[i], i, stamp));
  }
  return topicMessage("/objects", TopicDelivery::latched, time_ns, array);
}

void WorldTopics::begin(McapRecording& recording, const RunNote& note, const ChangedObjects& objects,
                        std::uint64_t time_ns) {
  const std::string file = std::filesystem::path(note.world.file).filename().string();
  recording.addMetadata({"robosim",
                         {{"world", file},
                          {"world_version", note.world_version},
                          {"seed", std::to_string(note.seed)},
                          {"period_s", textOf(note.period_s)},
                          {"controllers", textOf(note.controllers)}}});
  if (!note.world.text.empty()) recording.attach({time_ns, 0, file, "application/xml", note.world.text});
  recording.write(map(time_ns));
  recording.write(this->objects(objects, time_ns));
  startFrom(objects, "");
}

void WorldTopics::startFrom(const ChangedObjects& objects, const std::string& winner) {
  objects_ = objects;
  winner_ = winner;
}

TopicMessage WorldTopics::objects(const ChangedObjects& objects, std::uint64_t time_ns) const {
  return markers(objects.orThose(model_->world.objects), nullptr, time_ns);
}

std::vector<TopicMessage> WorldTopics::of(const ChangedObjects& objects, const std::vector<std::string>& notes,
                                          const std::string& winner, std::uint64_t time_ns) {
  if (objects.isSameList(objects_)) return of(objects, nullptr, notes, winner, time_ns);
  const auto& of_world = model_->world.objects;
  const auto moved = movedBetween(objects_.orThose(of_world), objects.orThose(of_world));
  return of(objects, &moved, notes, winner, time_ns);
}

std::vector<TopicMessage> WorldTopics::of(const ChangedObjects& objects,
                                          const std::optional<std::vector<std::uint32_t>>* moved,
                                          const std::vector<std::string>& notes, const std::string& winner,
                                          std::uint64_t time_ns) {
  std::vector<TopicMessage> messages;
  for (const auto& text : notes) {
    messages.push_back(topicMessage("/interventions", TopicDelivery::steady, time_ns, ros::String{text}));
  }
  if (moved && (!*moved || !(*moved)->empty())) {
    const auto& now = objects.orThose(model_->world.objects);
    messages.push_back(markers(now, *moved ? &**moved : nullptr, time_ns));
  }
  objects_ = objects;
  if (winner != winner_) {
    const nlohmann::ordered_json event{{"event", "won"}, {"robot", winner}};
    messages.push_back(topicMessage("/events", TopicDelivery::steady, time_ns, ros::String{textOf(event)}));
    winner_ = winner;
  }
  return messages;
}

void WorldTopics::end(McapRecording& recording, const RunNote& note) {
  std::map<std::string, std::string> values;
  for (const auto& [key, value] : note.outcome.items()) {
    values[key] = value.is_string() ? value.get<std::string>() : textOf(value);
  }
  recording.addMetadata({"robosim_outcome", values});
}

}  // namespace robosim
