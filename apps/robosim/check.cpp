#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "aria/robot_list.h"
#include "base/angle_units.h"
#include "base/printable_text.h"
#include "base/text_table.h"
#include "base/xml_parser.h"
#include "environment/world_changes.h"
#include "robosim/arguments.h"
#include "robosim/check_errors.h"
#include "robosim/subcommands.h"
#include "robots/fleet.h"
#include "robots/free_space.h"
#include "robots/robot_type_includes.h"
#include "robots/world_source.h"
#include "run/json_text.h"
#include "run/local_run.h"
#include "world/raster.h"
#include "world/world_file.h"

namespace robosim {
namespace {

/// Contents of a checked file, or its errors.
struct Checked {
  ErrorList errors;
  std::string kind;
  std::vector<std::string> robots;
  std::size_t objects = 0;
  std::size_t maps = 0;
  double open_edge_m = 0;
  std::vector<std::string> warnings;
  Rows contents;             ///< text output
  ErrorModels error_models;  ///< of a world or a robot type
  /// @name Of a world of Stage
  ///@{
  std::vector<std::string> notes;
  std::optional<TranslatedStageWorld::Properties> properties;
  ///@}
};

/// A pose in metres and degrees, to the millimetre and the tenth of a degree.
std::string placeText(const mrpt::math::TPose2D& pose) {
  return "at (" + fixed(pose.x, 3) + ", " + fixed(pose.y, 3) + ") m, heading " + fixed(toDegrees(pose.phi), 1) + "°";
}

/// Name of the start pose that a map assigns to this robot: "start 1 of maps/office.map"; empty for a robot with its
/// own.
std::string startText(const World& world, const mrpt::math::TPose2D& pose) {
  for (const auto& map : world.maps) {
    for (std::size_t i = 0; i < map.plan.starts.size(); ++i) {
      const auto start = map.world_from_map + map.plan.starts[i];
      if (start.x == pose.x && start.y == pose.y) {
        return ", start " + std::to_string(i + 1) + " of " + std::to_string(map.plan.starts.size()) + " of the map " +
               map.file;
      }
    }
  }
  return "";
}

/// "6, 1 of them hot, 3 movable, 1 door": how many objects there are, and how many of those that are special.
std::string objectsText(const World& world) {
  std::size_t hot = 0, movable = 0, doors = 0, people = 0, belts = 0;
  for (const auto& object : world.objects) {
    hot += object.body.heat_celsius != 0 ? 1 : 0;
    movable += object.movable ? 1 : 0;
    doors += object.door ? 1 : 0;
    people += object.walker ? 1 : 0;
    belts += object.conveyor ? 1 : 0;
  }
  std::string text = std::to_string(world.objects.size()) + ", " + std::to_string(hot) + " of them hot";
  const auto add = [&](std::size_t count, const char* one, const char* several) {
    if (count > 0) text += ", " + std::to_string(count) + " " + (count == 1 ? one : several);
  };
  add(movable, "movable", "movable");
  add(doors, "door", "doors");
  add(people, "person", "people");
  add(belts, "belt", "belts");
  return text;
}

/// Total length of walls and boxes that stay where they are in plan, along their longer sides.
double wallLength(const World& world) {
  double length_m = 0;
  for (const auto& object : world.objects) {
    const auto* cube = std::get_if<Cube>(&object.body.shape);
    if (cube && object.isStationary() && !object.conveyor) length_m += std::max(cube->length_m, cube->width_m);
  }
  for (const auto& map : world.maps) {
    for (const auto& cells : map.plan.occupied) length_m += std::max(cells.columns, cells.rows) * map.plan.cell_m;
    for (const auto& box : map.plan.boxes) length_m += std::max(box.length_m, box.width_m);
  }
  return length_m;
}

/// Warns where robots can reach the edge of the world, which stops them like a wall but returns no echoes.
void checkEdge(const World& world, const Fleet& fleet, Checked& checked) {
  constexpr double kMaxCells = 2e7;
  constexpr double kUsualRadius_m = 0.25;
  double radius_m = fleet.robots.empty() ? kUsualRadius_m : fleet.robots.front().info.radius_m;
  std::vector<HeightSpan> heights;
  std::vector<mrpt::math::TPoint2D> starts;
  for (const auto& robot : fleet.robots) {
    radius_m = std::min(radius_m, robot.info.radius_m);
    heights.push_back(robot.body().heights());
    starts.emplace_back(robot.world_from_start.x, robot.world_from_start.y);
  }
  const auto& b = world.bounds;
  if (!((b.x_max - b.x_min) / radius_m * ((b.y_max - b.y_min) / radius_m) * 4 < kMaxCells)) {
    checked.contents.push_back({"edge", "not examined: the surface is too large"});
    return;
  }
  FreeSpace free(world, radius_m, robotHeights(heights));
  if (starts.empty()) free.blockUnknown(world);
  checked.open_edge_m = free.openEdge(starts.empty() ? free.largestRegion() : free.reachableFrom(starts));
  if (checked.open_edge_m == 0) return;
  checked.warnings.push_back("robots can reach " + fixed(checked.open_edge_m, 1) +
                             " m of the surface's edge, where no wall stands: the edge stops them, and only "
                             "bumpers and stalls report it; close it with walls if that is not intended");
}

std::string describe(const FloorPlan& plan) {
  std::string text;
  if (plan.columns > 0) {
    text = withCommas(plan.columns) + " × " + withCommas(plan.rows) + " cells of " + toText(plan.cell_m) + " m, " +
           withCommas(plan.occupiedCells()) + " of them occupied, in " + withCommas(plan.occupied.size()) + " boxes";
  }
  if (plan.columns > 0 && !plan.boxes.empty()) text += "; ";
  if (!plan.boxes.empty()) text += withCommas(plan.boxes.size()) + " walls";
  return text;
}

/// Changes of a world, and the seed for random places.
struct Additions {
  WorldChanges changes;
  std::uint64_t seed = kDefaultSeed;
  std::string controller;  ///< of all robots; empty: those of the world
};

/// Errors of robots whose controller, of the world or of --controller, lacks a sensor; a warning of those that name
/// none, and lack what the default requires: another process may drive them, or --controller name one.
void checkControllersOf(const LoadedWorld& loaded, const std::string& file, const std::string& controller,
                        Checked& checked) {
  const auto names_none = [](const FleetRobot& robot, std::size_t) { return robot.controller->empty(); };
  const auto names_one = [](const FleetRobot& robot, std::size_t) { return !robot.controller->empty(); };
  if (!controller.empty()) return checkControllers(loaded, file, controller, checked.errors);
  checkControllers(loaded, file, "", checked.errors, names_none);
  ErrorList of_default;
  checkControllers(loaded, file, "", of_default, names_one);
  if (of_default.empty()) return;
  const std::size_t more = of_default.count() - 1;
  checked.warnings.push_back("without --controller, " + of_default.errors().front() +
                             (more == 0 ? "" : "; so do " + withCommas(more) + " further robots"));
}

/// @param types those of the world itself, before those in folders
void checkWorld(const std::string& file, World world_in_file, RobotTypes types, const Additions& additions,
                Checked& checked) {
  types.merge(robotTypesIn(robotTypeFolders(file)));
  std::vector<std::string> moved;
  LoadedWorld loaded =
      placedWorld(std::move(world_in_file), file, types, checkController, additions.seed, checked.errors, &moved);
  if (!additions.changes.isNone() && checked.errors.empty()) {
    const WorldSource changed = withChanges(readWorldSource(file), additions.changes, additions.seed);
    loaded = loadWorld(changed, checkController);
    for (const auto& [name, type] : changed.robot_types) types.insert_or_assign(name, type);
  }
  if (checked.errors.empty()) checkControllersOf(loaded, file, additions.controller, checked);
  const World& world = loaded.world;
  const Fleet& fleet = loaded.fleet;
  for (const auto& warning : moved) checked.warnings.push_back(warning.substr(warning.find(": ") + 2));
  for (const auto& robot : world.robots) checked.robots.push_back(robot.name);
  checked.objects = world.objects.size();
  checked.maps = world.maps.size();

  const auto& b = world.bounds;
  checked.contents = {{"surface", fixed(b.x_max - b.x_min, 1) + " m × " + fixed(b.y_max - b.y_min, 1) +
                                      " m; one length unit of the file is " + toText(world.unit_m) + " m"},
                      {"objects", objectsText(world)},
                      {"walls", fixed(wallLength(world), 1) + " m in total, along their longer sides"},
                      {"robots", std::to_string(world.robots.size())}};
  for (const auto& map : world.maps) {
    checked.contents.insert(checked.contents.end() - 1, {"map " + map.file, describe(map.plan)});
    for (const auto& warning : map.plan.warnings) checked.warnings.push_back("map " + map.file + ": " + warning);
  }
  constexpr std::size_t kMaxListed = 20;
  for (std::size_t i = 0; i < std::min(kMaxListed, fleet.robots.size()); ++i) {
    const auto& robot = fleet.robots[i];
    std::string sensors;
    for (const auto& sensor : *robot.info.sensors) sensors += (sensors.empty() ? "" : " ") + sensor.label;
    checked.contents.push_back(
        {"  " + robot.info.name,
         robot.info.type->model + ", " + (robot.controller->empty() ? "default controller" : *robot.controller) + ", " +
             sensors + "; " + placeText(robot.world_from_start) + startText(world, robot.world_from_start)});
  }
  if (fleet.robots.size() > kMaxListed) {
    checked.contents.push_back({"  …", std::to_string(fleet.robots.size() - kMaxListed) + " more"});
  }
  if (checked.errors.empty()) {
    checked.error_models = listErrorModels(world, fleet, types);
    checked.error_models.addTo(checked.contents);
  }
  if (checked.errors.empty()) checkEdge(world, fleet, checked);
}

void checkStageWorld(const std::string& file, const Additions& additions, Checked& checked) {
  StageNotes notes;
  const WorldSource source = readWorldSource(file, &notes);
  World world = parseWorld(source.text, source.file, makeProvider(source.file, source.files), checked.errors);
  checkWorld(file, std::move(world), source.robot_types, additions, checked);
  checked.properties = notes.properties;
  checked.contents.push_back(
      {"properties", withCommas(notes.properties.translated) + " of " + withCommas(notes.properties.all) +
                         " translated, " + withCommas(notes.properties.display) + " of Stage's window and clock, " +
                         withCommas(notes.properties.ignored) + " ignored"});
  checked.notes = std::move(notes.lines);
}

void checkRobotList(const std::string& file, const XmlElement& root, Checked& checked) {
  const auto robots = robotListFrom(root, file, checked.errors);
  checked.contents.push_back({"robots", std::to_string(robots.size())});
  for (const auto& robot : robots) {
    checked.robots.push_back(robot.name);
    checked.contents.push_back(
        {"  " + robot.name, robot.hostname + ":" + std::to_string(robot.port) + (robot.primary ? ", primary" : "")});
  }
}

void checkRobotModel(const std::string& file, const XmlElement& element, Checked& checked) {
  const XmlElement root = withIncludedFiles(element, file);
  const RobotModel model = modelOf(root, file, {}, checked.errors);
  checked.robots.push_back(model.type->model);
  checked.contents = {{"robot type", model.type->model}, {"radius", fixed(model.radius_m, 3) + " m"}};
  if (!model.sensor_infos) return;
  for (const auto& sensor : *model.sensor_infos) checked.contents.push_back({"  " + sensor.label, nameOf(sensor.kind)});
  if (!checked.errors.empty()) return;
  checked.error_models = listErrorModels(root, model);
  checked.error_models.addTo(checked.contents);
}

Checked check(const std::string& file, const Additions& additions) {
  Checked checked;
  const auto refuse_additions = [&] {
    if (additions.changes.isNone() && additions.controller.empty()) return;
    throw ConfigError(file + ": is a " + checked.kind + "; options of robots apply to a world or a map only");
  };
  try {
    if (isMapFile(file)) {
      checked.kind = "map";
      checkWorld(file, readWorld(file, checked.errors), {}, additions, checked);
      return checked;
    }
    if (isStageFile(file)) {
      checked.kind = "world of Stage";
      checkStageWorld(file, additions, checked);
      return checked;
    }
    // Read once, because a pipe can be read only once.
    std::string text = readXmlText(file);
    const XmlElement root = parseXml(text, file);
    if (root.name == "RobotInfo") {
      checked.kind = "robot list";
      refuse_additions();
      checkRobotList(file, root, checked);
    } else if (root.name == "robot") {
      checked.kind = "robot type";
      refuse_additions();
      checkRobotModel(file, root, checked);
    } else {
      checked.kind = "world";
      checkWorld(file, parseWorld(std::move(text), file, filesOnDisk(file), checked.errors), {}, additions, checked);
    }
  } catch (const ConfigError& error) {
    checked.errors.add(error);
  }
  return checked;
}

void report(const std::string& file, const Checked& checked, bool as_json) {
  const bool ok = checked.errors.empty();
  if (as_json) {
    nlohmann::ordered_json result = {{"file", file},
                                     {"kind", checked.kind},
                                     {"ok", ok},
                                     {"errors", checked.errors.errors()},
                                     {"warnings", checked.warnings},
                                     {"open_edge_m", checked.open_edge_m},
                                     {"robots", checked.robots},
                                     {"objects", checked.objects},
                                     {"maps", checked.maps},
                                     {"error_models", checked.error_models.json()}};
    if (const auto& properties = checked.properties) {
      result["notes"] = checked.notes;
      result["properties"] = {{"all", properties->all},
                              {"translated", properties->translated},
                              {"display", properties->display},
                              {"ignored", properties->ignored}};
    }
    std::cout << jsonText(result) << '\n';
  } else if (ok) {
    std::cout << "ok: " << printableText(file) << " (" << checked.kind << ")\n" << listing(checked.contents);
    for (const auto& warning : checked.warnings) {
      std::cout << "warning: " << printableText(file) << ": " << warning << '\n';
    }
    for (const auto& note : checked.notes) std::cout << "note: " << printableText(note) << '\n';
  } else {
    for (const auto& error : checked.errors.errors()) std::cout << error << '\n';
    const auto count = checked.errors.errors().size();
    std::cout << printableText(file) << ": " << count << (count == 1 ? " error\n" : " errors\n");
  }
  if (!ok) throw Exit{kBadInput};
}

}  // namespace

void addCheck(CLI::App& program) {
  struct CheckArguments {
    std::string file;
    Additions additions;
    bool json = false;
  };
  auto* command = addSubcommand(program, "check");
  auto arguments = std::make_shared<CheckArguments>();
  command->add_option("FILE", arguments->file, "a world, also of Stage, a map, a robot type, or a 2005 robot list")
      ->transform(inputFile([] {
        std::vector<FileKind> kinds = kWorldKinds;
        kinds.insert(kinds.end(), {FileKind::robot_type, FileKind::robot_list});
        return kinds;
      }()))
      ->required();
  addRobotOptions(*command, arguments->additions.changes);
  addRandomStartsOption(*command, arguments->additions.changes);
  addNoiseOption(*command, arguments->additions.changes);
  addSeedOption(*command, arguments->additions.seed, "seed of random places: of robots, starts and <scatter>");
  addControllerOption(*command, arguments->additions.controller,
                      "check that all robots have what this controller requires, instead of those in the world")
      ->group(kWorldGroup);
  command->add_flag("--json", arguments->json,
                    "print one JSON object: ok, errors, warnings, open_edge_m, robots (names), objects and maps "
                    "(counts), error_models (sensors, communication, reflectivity)");
  command->callback(
      [arguments] { report(arguments->file, check(arguments->file, arguments->additions), arguments->json); });
}

}  // namespace robosim
