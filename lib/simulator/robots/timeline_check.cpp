#include "robots/timeline_check.h"

#include <algorithm>
#include <set>
#include <vector>

#include "base/nearest_name.h"

namespace robosim {
namespace {

/// The names of a world while its timeline is checked.
struct Names {
  std::set<std::string> robots, objects;

  bool has(const std::string& name) const { return robots.contains(name) || objects.contains(name); }
  std::string unknown(const std::string& name, const char* what) const {
    std::vector<std::string> known(robots.begin(), robots.end());
    known.insert(known.end(), objects.begin(), objects.end());
    return "'" + name + "' is not the name of " + what + didYouMean(name, known);
  }
};

/// Checks one change, and takes its effect on the names. Each function returns what is wrong; empty for nothing.
struct NameCheck {
  Names& names;

  std::string operator()(const PlaceBody& place) const {
    return names.has(place.name) ? "" : names.unknown(place.name, "a robot or an object");
  }
  std::string operator()(const AddObject& add) const {
    if (names.has(add.object.name))
      return "there is a robot or an object named '" + add.object.name + "' already; use another name";
    names.objects.insert(add.object.name);
    return "";
  }
  std::string operator()(const AddRobot& add) const {
    if (names.has(add.name)) return "there is a robot or an object named '" + add.name + "' already; use another name";
    if (!add.neighbour.empty() && !names.robots.contains(add.neighbour))
      return "neighbour " + names.unknown(add.neighbour, "a robot");
    names.robots.insert(add.name);
    return "";
  }
  std::string operator()(const RemoveBody& remove) const {
    if (names.objects.erase(remove.name) > 0 || names.robots.contains(remove.name)) return "";
    return names.unknown(remove.name, "a robot or an object");
  }
  std::string operator()(const ChangeObject& change) const {
    return names.objects.contains(change.name) ? "" : names.unknown(change.name, "an object");
  }
  std::string operator()(const ChangeActivity& change) const {
    return names.robots.contains(change.robot) ? "" : names.unknown(change.robot, "a robot");
  }
  std::string operator()(const ChangeRadio&) const { return ""; }
  std::string operator()(const OpenDoor& open) const {
    return names.objects.contains(open.name) ? "" : names.unknown(open.name, "a door");
  }
  std::string operator()(const EndRun&) const { return ""; }
};

}  // namespace

void checkTimeline(const World& world, const std::string& world_file, ErrorList& errors) {
  if (world.timeline.empty()) return;
  Names names;
  for (const auto& robot : world.robots) names.robots.insert(robot.name);
  for (const auto& object : world.objects) names.objects.insert(object.name);
  for (const TimedChange& timed : world.timeline) {
    const std::string fault = std::visit(NameCheck{names}, timed.change);
    if (!fault.empty()) errors.add(world.fileOf(timed.line, world_file), timed.line.number, fault);
  }
}

}  // namespace robosim
