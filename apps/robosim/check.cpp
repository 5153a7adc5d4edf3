#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "maze/controllers.h"
#include "remote/robot_list.h"
#include "robosim/local_run.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"
#include "robots/fleet.h"
#include "world/world_file.h"

namespace robosim {
namespace {

/// What a file holds, or what is wrong with it.
struct Checked {
  ErrorList errors;
  std::string kind;
  std::vector<std::string> robots;
  std::size_t objects = 0;
  std::size_t maps = 0;
  Rows contents;  ///< for a person
};

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

void checkWorld(const std::string& file, Checked& checked) {
  LoadedWorld loaded;
  loaded.world = readWorld(file, checked.errors);
  loaded.fleet =
      buildFleet(loaded.world, file, robotTypesIn(robotTypeFolders(file)), controllerNames(), checked.errors);
  if (checked.errors.empty()) checkControllers(loaded, file, "", checked.errors);
  const World& world = loaded.world;
  const Fleet& fleet = loaded.fleet;
  for (const auto& robot : world.robots) checked.robots.push_back(robot.name);
  checked.objects = world.objects.size();
  checked.maps = world.maps.size();

  const auto& b = world.bounds;
  std::size_t hot = 0;
  for (const auto& object : world.objects) hot += object.body.heat_celsius != 0 ? 1 : 0;
  checked.contents = {{"surface", fixed(b.x_max - b.x_min, 1) + " m × " + fixed(b.y_max - b.y_min, 1) +
                                      " m; one length unit of the file is " + toText(world.unit_m) + " m"},
                      {"objects", std::to_string(world.objects.size()) + ", " + std::to_string(hot) + " of them hot"},
                      {"robots", std::to_string(world.robots.size())}};
  for (const auto& map : world.maps)
    checked.contents.insert(checked.contents.end() - 1, {"map " + map.file, describe(map.plan)});
  constexpr std::size_t kMostListed = 20;
  for (std::size_t i = 0; i < std::min(kMostListed, fleet.robots.size()); ++i) {
    const auto& robot = fleet.robots[i];
    std::string sensors;
    for (const auto& sensor : *robot.info.sensors) sensors += (sensors.empty() ? "" : " ") + sensor.label;
    checked.contents.push_back(
        {"  " + robot.info.name, robot.info.model + ", " +
                                     (robot.controller.empty() ? "default controller" : robot.controller) + ", " +
                                     sensors});
  }
  if (fleet.robots.size() > kMostListed) {
    checked.contents.push_back({"  …", std::to_string(fleet.robots.size() - kMostListed) + " more"});
  }
}

void checkRobotList(const std::string& file, Checked& checked) {
  const auto robots = readRobotList(file, checked.errors);
  checked.contents.push_back({"robots", std::to_string(robots.size())});
  for (const auto& robot : robots) {
    checked.robots.push_back(robot.name);
    checked.contents.push_back(
        {"  " + robot.name, robot.hostname + ":" + std::to_string(robot.port) + (robot.primary ? ", primary" : "")});
  }
}

void checkRobotModel(const std::string& file, Checked& checked) {
  const RobotModel model = readRobotModel(file, checked.errors);
  checked.robots.push_back(model.name);
  checked.contents = {{"robot type", model.name}, {"radius", fixed(model.radius_m, 3) + " m"}};
  if (!model.sensor_infos) return;
  for (const auto& sensor : *model.sensor_infos) checked.contents.push_back({"  " + sensor.label, nameOf(sensor.kind)});
}

Checked check(const std::string& file) {
  Checked checked;
  try {
    const std::string root = isMapFile(file) ? "map" : readXmlFile(file).name;
    if (root == "map") {
      checked.kind = "map";
      checkWorld(file, checked);
    } else if (root == "RobotInfo") {
      checked.kind = "robot list";
      checkRobotList(file, checked);
    } else if (root == "robot") {
      checked.kind = "robot type";
      checkRobotModel(file, checked);
    } else {
      checked.kind = "world";
      checkWorld(file, checked);
    }
  } catch (const ConfigError& error) {
    checked.errors.add(error);
  }
  return checked;
}

void report(const std::string& file, const Checked& checked, bool as_json) {
  const bool ok = checked.errors.empty();
  if (as_json) {
    std::cout << nlohmann::ordered_json{{"file", file},
                                        {"kind", checked.kind},
                                        {"ok", ok},
                                        {"errors", checked.errors.errors()},
                                        {"robots", checked.robots},
                                        {"objects", checked.objects},
                                        {"maps", checked.maps}}
                     .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
              << '\n';
  } else if (ok) {
    std::cout << "ok: " << file << " (" << checked.kind << ")\n" << listing(checked.contents);
  } else {
    for (const auto& error : checked.errors.errors()) std::cout << error << '\n';
    const auto count = checked.errors.errors().size();
    std::cout << file << ": " << count << (count == 1 ? " error\n" : " errors\n");
  }
  if (!ok) throw Exit{kBadInput};
}

}  // namespace

void addCheck(CLI::App& program) {
  struct Arguments {
    std::string file;
    bool json = false;
  };
  auto* command =
      program.add_subcommand("check", "Say whether a world file is right and what is in it, or list every error");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("FILE", arguments->file, "a world, a map, a robot type, or a 2005 robot list")->required();
  command->add_flag("--json", arguments->json,
                    "print one JSON object: ok, errors, robots (names), objects and maps (counts)");
  command->callback([arguments] { report(arguments->file, check(arguments->file), arguments->json); });
}

}  // namespace robosim
