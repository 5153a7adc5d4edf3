#include "world/placement_reader.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "base/error_list.h"
#include "base/label.h"
#include "world/body_xml.h"
#include "world/controller_xml.h"

namespace robosim {

WorldObject PlacementReader::readPrimitive(XmlReader& primitive, Place place) {
  WorldObject object;
  object.line = primitive.line();
  if (auto solid = solidIn(primitive)) {
    object.line = solid->line();
    object.name = place == Place::given ? readName(*solid) : solid->word("name");
    object.body = readBody(*solid, world_.unit_m, place == Place::given);
    readMotion(*solid, world_.unit_m, object);
    if (place != Place::given && object.door) {
      solid->error("is a door, which has its place in a wall; give it in an <object>");
    }
    if (place != Place::given && object.walker && !object.walker->route.empty()) {
      solid->error("is a walker with a route; give it in an <object>, or let it wander by wanders_within");
    }
    solid->finish();
  } else {
    primitive.error("contains neither a <cylinder> nor a <cube>; add one");
  }
  primitive.finish();
  return object;
}

RobotPlacement PlacementReader::readRobot(XmlReader& robot, Place place) {
  RobotPlacement placement;
  placement.line = robot.line();
  placement.model = robot.word("model", "");
  if (auto solid = solidIn(robot)) {
    placement.name = readRobotName(*solid, place);
    placement.body = readBody(*solid, world_.unit_m, place == Place::given);
    placement.world_from_robot = placement.body->world_from_body;
    solid->flag("stationary", false);  // 2005 files set it for robots too; ignored
    solid->finish();
  } else if (robot.has("model")) {
    placement.name = readRobotName(robot, place);
    if (place == Place::given) placement.world_from_robot = readPlace(robot);
    placement.color = readColor(robot);
  } else {
    robot.error("has no body; add a <cylinder> or <cube>, or a <model> that has one");
  }
  for (const auto& sensor : robot.all("sensor")) placement.sensors.push_back(sensor.element());
  if (auto sensors = robot.child("sensors")) {
    for (const auto& sensor : sensors->all()) placement.sensors.push_back(sensor.element());
    sensors->finish();
  }
  if (auto drive = robot.child("drive")) placement.drive = drive->element();
  const auto& children = robot.element().children;
  const auto controller = std::find_if(children.begin(), children.end(),
                                       [](const XmlElement& child) { return child.name == "controller"; });
  placement.controller_line = controller == children.end() ? robot.line() : controller->line;
  placement.controller = readController(robot);
  placement.neighbour = robot.word("neighbour", "");
  if (!placement.neighbour.empty()) neighbours_.push_back({robot, place, placement.name, placement.neighbour});
  robot.finish();
  return placement;
}

/// A robot without a position gets the next start pose that a map gives.
mrpt::math::TPose2D PlacementReader::readPlace(XmlReader& robot) {
  if (robot.has("x") || robot.has("y") || next_start_ == starts_.size()) return readPose(robot, world_.unit_m);
  mrpt::math::TPose2D start = starts_[next_start_++];
  start.phi = robot.number("direction", Bounds::any(), start.phi);
  return start;
}

std::string PlacementReader::readName(XmlReader& reader) {
  std::string name = reader.word("name");
  if (name.empty()) return name;
  if (const auto taken_at = takeName(name, reader.line())) {
    reader.errorAt("name", "is taken already, " + *taken_at + "; give each object and robot a name of its own");
  }
  return name;
}

std::optional<std::string> PlacementReader::takeName(const std::string& name, const SourceLine& line) {
  const auto [first, is_new] = line_of_name_.emplace(name, line);
  if (is_new) return std::nullopt;
  const std::string text = "in line " + std::to_string(first->second.number);
  // The file is given when it is another than that of the reported line.
  return first->second.file == line.file ? text : text + " of " + world_.fileOf(first->second, file_);
}

std::string PlacementReader::readRobotName(XmlReader& reader, Place place) {
  std::string name = place == Place::given ? readName(reader) : reader.word("name");
  const std::string longest = place == Place::given ? name : name + std::to_string(kScatteredMax);
  if (const std::string fault = robotNameError(longest); !fault.empty()) reader.errorAt("name", fault);
  return name;
}

std::vector<std::string> PlacementReader::robotNames() const {
  std::vector<std::string> names;
  for (const auto& robot : world_.robots) names.push_back(robot.name);
  std::size_t copies = 0;
  for (const auto& scatter : world_.scatters) {
    if (!std::holds_alternative<RobotPlacement>(scatter.copied)) continue;
    copies += static_cast<std::size_t>(scatter.count);
    if (copies > kScatteredMax) break;  // an error, which has been reported
    for (int k = 1; k <= scatter.count; ++k) names.push_back(scatter.nameOf(k));
  }
  return names;
}

bool PlacementReader::isOwnCopy(const Neighbour& neighbour) const {
  if (neighbour.place == Place::given) return false;
  for (const auto& scatter : world_.scatters) {
    const auto* robot = std::get_if<RobotPlacement>(&scatter.copied);
    if (!robot || robot->name != neighbour.robot_name) continue;
    for (int k = 1; k <= scatter.count; ++k) {
      if (scatter.nameOf(k) == neighbour.name) return true;
    }
  }
  return false;
}

void PlacementReader::checkNeighbours() {
  if (neighbours_.empty()) return;
  const std::vector<std::string> names = robotNames();
  const std::unordered_set<std::string> known(names.begin(), names.end());
  const std::string fix = "; the robots are: " + listed(names);
  for (auto& neighbour : neighbours_) {
    XmlReader& robot = neighbour.robot;
    if (neighbour.place == Place::given && neighbour.name == neighbour.robot_name) {
      robot.errorAt("neighbour", "is the robot itself; name another one, or drop it");
    } else if (isOwnCopy(neighbour)) {
      robot.errorAt("neighbour", "is one of the copies themselves; name another robot, or drop it and add " +
                                     std::string("neighbours=\"ring\" to the <scatter>"));
    } else if (!known.contains(neighbour.name)) {
      robot.errorAt("neighbour", "is not the name of a robot" + fix);
    }
  }
}

}  // namespace robosim
