#include "run_page/page_world.h"

#include <cmath>
#include <cstdint>
#include <cstdio>

namespace robosim {
namespace {

using nlohmann::ordered_json;

double metres(double value_m) { return std::round(value_m * 1e4) / 1e4; }
double radians(double value_rad) { return std::round(value_rad * 1e6) / 1e6; }

ordered_json at(const mrpt::math::TPose2D& pose) { return {metres(pose.x), metres(pose.y), radians(pose.phi)}; }

std::string hexOf(const std::array<float, 3>& color) {
  char text[8];
  const auto part = [&](std::size_t i) { return static_cast<unsigned>(std::lround(color[i] * 255)) & 0xFFu; };
  std::snprintf(text, sizeof text, "#%02x%02x%02x", part(0), part(1), part(2));
  return text;
}

/// Outline and heights of a body.
ordered_json shapeOf(const Body& body) {
  ordered_json json;
  if (const auto* cube = std::get_if<Cube>(&body.shape)) {
    json["size"] = {metres(cube->length_m), metres(cube->width_m)};
  } else {
    json["radius"] = metres(std::get<Cylinder>(body.shape).radius_m);
  }
  const HeightSpan heights = body.heights();
  json["z"] = {metres(heights.z_min_m), metres(heights.z_max_m)};
  return json;
}

/// Rectangles of cells as one list of columns, rows, numbers of columns and of rows, column and row as differences to
/// the rectangle before.
ordered_json cellsOf(const std::vector<CellRectangle>& rectangles) {
  ordered_json json = ordered_json::array();
  std::int64_t column = 0, row = 0;
  for (const auto& cells : rectangles) {
    json.push_back(cells.column - column);
    json.push_back(cells.row - row);
    json.push_back(cells.columns);
    json.push_back(cells.rows);
    column = cells.column;
    row = cells.row;
  }
  return json;
}

ordered_json mapOf(const WorldMap& map) {
  ordered_json boxes = ordered_json::array();
  for (const auto& box : map.plan.boxes) {
    boxes.push_back({metres(box.map_from_box.x), metres(box.map_from_box.y), radians(box.map_from_box.phi),
                     metres(box.length_m), metres(box.width_m)});
  }
  return {{"at", at(map.world_from_map)},
          {"height", metres(map.height_m)},
          {"color", hexOf(map.color)},
          {"columns", map.plan.columns},
          {"rows", map.plan.rows},
          {"cell", map.plan.cell_m},
          {"grid", at(map.plan.map_from_grid)},
          {"occupied", cellsOf(map.plan.occupied)},
          {"unknown", cellsOf(map.plan.unknown)},
          {"boxes", std::move(boxes)}};
}

ordered_json sensorOf(const SensorInfo& sensor) {
  ordered_json beams = ordered_json::array();
  for (const auto& beam : sensor.beams) {
    const auto& pose = beam.robot_from_beam;
    beams.push_back({metres(pose.x), metres(pose.y), metres(pose.z), radians(pose.yaw)});
  }
  ordered_json json{{"label", sensor.label}, {"kind", nameOf(sensor.kind)}};
  if (!sensor.beams.empty()) json["beams"] = std::move(beams);
  if (sensor.range_max_m > 0) json["max"] = metres(sensor.range_max_m);
  if (sensor.beam_width_rad > 0) json["width"] = radians(sensor.beam_width_rad);
  if (sensor.pans) json["pans"] = true;
  return json;
}

}  // namespace

ordered_json pageWorld(const World& world) {
  ordered_json maps = ordered_json::array();
  for (const auto& map : world.maps) maps.push_back(mapOf(map));
  const Bounds2D& b = world.bounds;
  return {{"name", world.name},
          {"bounds", {metres(b.x_min), metres(b.x_max), metres(b.y_min), metres(b.y_max)}},
          {"maps", std::move(maps)}};
}

ordered_json pageObjects(const std::vector<WorldObject>& objects) {
  ordered_json json = ordered_json::array();
  for (const auto& object : objects) {
    ordered_json described = shapeOf(object.body);
    described["at"] = at(object.body.world_from_body);
    described["color"] = hexOf(object.body.color);
    if (!object.name.empty()) described["name"] = object.name;
    if (object.body.heat_celsius != 0) described["hot"] = true;
    if (object.body.light_cd != 0) described["light"] = true;
    if (object.door) described["kind"] = "door";
    if (object.walker) described["kind"] = "person";
    if (object.movable) described["kind"] = "movable";
    if (object.conveyor) described["kind"] = "conveyor";
    json.push_back(std::move(described));
  }
  return json;
}

ordered_json pageRobot(const FleetRobot& robot, ordered_json& types) {
  ordered_json type = shapeOf(robot.body());
  type["model"] = robot.info.type->model;
  type["deck"] = robot.model && robot.model->look == BodyLook::deck;
  type["sensors"] = ordered_json::array();
  if (robot.info.sensors) {
    for (const auto& sensor : *robot.info.sensors) type["sensors"].push_back(sensorOf(sensor));
  }
  std::size_t index = 0;
  while (index < types.size() && types[index] != type) ++index;
  if (index == types.size()) types.push_back(std::move(type));
  ordered_json json{{"name", robot.info.name}, {"type", index}, {"color", hexOf(robot.color)}};
  if (!robot.controller->empty()) json["controller"] = *robot.controller;
  return json;
}

std::string textOf(const ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace robosim
