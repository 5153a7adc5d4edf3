// robosim controllers, sensors and observers: what this program has, with all settings.
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/error_list.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "maze/controllers.h"
#include "robosim/subcommands.h"
#include "run/observer.h"
#include "sensors/registry.h"

namespace robosim {
namespace {

using Json = nlohmann::ordered_json;

struct ListArguments {
  std::vector<std::string> names;  ///< empty: all
  bool json = false;
};

/// The entries with these names. @throws ConfigError for a name that no entry has
std::vector<Json> selected(const std::vector<Json>& entries, const std::vector<std::string>& names,
                           const std::string& kind) {
  if (names.empty()) return entries;
  std::vector<Json> found;
  std::vector<std::string> known;
  for (const auto& entry : entries) known.push_back(entry["name"]);
  for (const auto& name : names) {
    for (const auto& entry : entries) {
      if (entry["name"] == name) found.push_back(entry);
    }
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw ConfigError("there is no " + kind + " '" + name + "'; known are: " + listed(known));
    }
  }
  return found;
}

Json parametersAsJson(const std::vector<Parameter>& declared) {
  Json all = Json::array();
  for (const auto& parameter : declared) {
    all.push_back({{"name", parameter.name},
                   {"default", parameter.default_value},
                   {"min", parameter.min},
                   {"max", parameter.max},
                   {"unit", parameter.unit},
                   {"help", parameter.help}});
  }
  return all;
}

std::vector<Json> controllersAsJson() {
  std::vector<Json> all;
  for (const auto& type : controllers().types()) {
    Json needs = Json::array();
    for (const SensorKind kind : type.needs) needs.push_back(nameOf(kind));
    all.push_back({{"name", type.name},
                   {"help", type.help},
                   {"needs", needs},
                   {"parameters", parametersAsJson(type.parameters)}});
  }
  return all;
}

std::vector<Json> observersAsJson() {
  std::vector<Json> all;
  for (const auto& type : observers().types()) {
    all.push_back({{"name", type.name}, {"help", type.help}, {"parameters", parametersAsJson(type.parameters)}});
  }
  return all;
}

std::vector<Json> sensorsAsJson() {
  std::vector<Json> all;
  for (const auto& type : sensorTypes()) {
    Json settings = Json::array();
    for (const auto& setting : settingsOf(type)) {
      settings.push_back({{"name", setting.name}, {"values", setting.values}, {"default", setting.default_text}});
    }
    all.push_back({{"name", type.name}, {"help", type.help}, {"settings", settings}});
  }
  return all;
}

std::string numberText(const Json& number) { return toText(number.get<double>()); }

/// Controllers, and observers, which need no sensors.
void printWithParameters(const std::vector<Json>& entries) {
  for (const auto& entry : entries) {
    std::cout << entry["name"].get<std::string>() << ": " << entry["help"].get<std::string>() << '\n';
    const std::vector<std::string> needs = entry.value("needs", std::vector<std::string>());
    if (!needs.empty()) std::cout << "  requires sensors of the kinds: " << listed(needs) << '\n';
    Rows rows;
    for (const auto& parameter : entry["parameters"]) {
      const std::string unit = parameter["unit"].get<std::string>();
      rows.push_back(
          {"  " + parameter["name"].get<std::string>(), "default " + numberText(parameter["default"]),
           numberText(parameter["min"]) + " to " + numberText(parameter["max"]) + (unit.empty() ? "" : " " + unit),
           parameter["help"].get<std::string>()});
    }
    std::cout << listing(rows);
  }
}

void printSensors(const std::vector<Json>& entries) {
  for (const auto& entry : entries) {
    std::cout << '<' << entry["name"].get<std::string>() << ">: " << entry["help"].get<std::string>() << '\n';
    Rows rows;
    for (const auto& setting : entry["settings"]) {
      const std::string fallback = setting["default"].get<std::string>();
      rows.push_back({"  " + setting["name"].get<std::string>(), fallback.empty() ? "required" : "default " + fallback,
                      setting["values"].get<std::string>()});
    }
    std::cout << listing(rows);
  }
}

void addList(CLI::App& program, const char* subcommand, const std::string& kind, std::vector<Json> (*all)(),
             void (*print)(const std::vector<Json>&), const std::string& footer) {
  auto* command = addSubcommand(program, subcommand);
  auto arguments = std::make_shared<ListArguments>();
  command->add_option("NAME", arguments->names, "list only these; default: all");
  command->add_flag("--json", arguments->json, "print one JSON array");
  command->footer(footer);
  command->callback([=] {
    const auto entries = selected(all(), arguments->names, kind);
    if (arguments->json) {
      std::cout << Json(entries).dump(2) << '\n';
    } else {
      print(entries);
    }
  });
}

}  // namespace

void addControllers(CLI::App& program) {
  addList(program, "controllers", "controller", controllersAsJson, printWithParameters,
          "In a world file:      <controller name=\"wall_follower\" distance_radii=\"2\"/>\n"
          "On the command line:  --controller \"wall_follower distance_radii=2\"");
}

void addObservers(CLI::App& program) {
  addList(program, "observers", "observer", observersAsJson, printWithParameters,
          "robosim run WORLD --observer \"coverage end_percent=90\"\n"
          "robosim bench metrics WORLD --observer coverage --controller wander --controller wall_follower");
}

void addSensors(CLI::App& program) {
  addList(
      program, "sensors", "sensor", sensorsAsJson, printSensors,
      "In a world file or a robot type:  <sensors><laser range_max_m=\"30\"><noise std_m=\"0.01\"/></laser></sensors>\n"
      "A setting is an attribute or a child element; a/b is the setting b of the child element a.");
}

}  // namespace robosim
