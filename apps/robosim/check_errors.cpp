#include "robosim/check_errors.h"

#include <set>

#include "robots/robot_type_includes.h"

namespace robosim {
namespace {

void addSensors(const std::string& of, const std::vector<XmlElement>& sensors, const RobotModel& model,
                ErrorModels& models) {
  for (const auto& sensor : sensors) {
    auto settings = readErrorSettings(sensor, {1, model.radius_m, model.body.height_m, model.sensors, 0});
    if (!settings.isNone()) models.sensors.push_back({of, sensor.name, std::move(settings)});
  }
}

/// Settings of the radio besides its range.
std::vector<std::pair<const char*, double>> settingsOf(const Communication& radio) {
  return {{"loss", radio.loss_probability},   {"wall_range", radio.wall_range_m}, {"wall_loss", radio.wall_loss},
          {"burst_gap_s", radio.burst_gap_s}, {"burst_s", radio.burst_s},         {"burst_loss", radio.burst_loss},
          {"delay_s", radio.delay_s},         {"rate_hz", radio.rate_hz}};
}

nlohmann::ordered_json toJson(const SensorErrorSettings& errors) {
  nlohmann::ordered_json settings = nlohmann::ordered_json::object();
  for (const auto* part : {&errors.given, &errors.defaults}) {
    for (const auto& [name, text] : *part) {
      const auto number = parseNumber(text);
      const nlohmann::ordered_json value = number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json(text);
      nlohmann::ordered_json& slot = settings[name];
      if (slot.is_null()) {
        slot = value;
      } else if (slot.is_array()) {
        slot.push_back(value);
      } else {
        slot = nlohmann::ordered_json::array({slot, value});
      }
    }
  }
  return settings;
}

}  // namespace

void ErrorModels::addTo(Rows& rows) const {
  for (const auto& sensor : sensors) {
    rows.push_back({"  " + (sensor.of.empty() ? "errors" : sensor.of), sensor.sensor + ": " + sensor.settings.text()});
  }
  if (!reflectivities.empty()) {
    std::vector<std::string> objects;
    for (const auto& [name, value] : reflectivities) objects.push_back(name + " " + toText(value));
    rows.push_back({"reflectivity", listed(objects) + "; by default " + toText(kReflectivity)});
  }
  if (!radio) return;
  std::string text = "range " + (radio->range_m ? toText(*radio->range_m) + " m" : "unlimited");
  for (const auto& [name, value] : settingsOf(*radio)) {
    text += std::string(", ") + name + " " + toText(value) + (std::string(name) == "wall_range" ? " m" : "");
  }
  rows.push_back({"communication", text});
}

nlohmann::ordered_json ErrorModels::json() const {
  nlohmann::ordered_json all{{"sensors", nlohmann::ordered_json::array()},
                             {"communication", nullptr},
                             {"reflectivity", nlohmann::ordered_json::object()}};
  for (const auto& sensor : sensors) {
    all["sensors"].push_back({{"of", sensor.of},
                              {"sensor", sensor.sensor},
                              {"noise", sensor.settings.set},
                              {"settings", toJson(sensor.settings)}});
  }
  for (const auto& [name, value] : reflectivities) all["reflectivity"][name] = value;
  if (!radio) return all;
  auto& communication = all["communication"];
  communication["range"] = radio->range_m ? nlohmann::ordered_json(*radio->range_m) : nlohmann::ordered_json(nullptr);
  for (const auto& [name, value] : settingsOf(*radio)) communication[name] = value;
  return all;
}

ErrorModels listErrorModels(const XmlElement& type, const RobotModel& model) {
  ErrorModels models;
  addSensors("", sensorsOf(type), model, models);
  return models;
}

ErrorModels listErrorModels(const World& world, const Fleet& fleet, const RobotTypes& types) {
  ErrorModels models;
  std::set<std::string> done;
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    const RobotPlacement& placed = world.robots[i];
    const auto type = types.find(placed.model);
    if (!placed.sensors.empty()) {
      addSensors(placed.name, placed.sensors, *fleet.robots[i].model, models);
    } else if (type != types.end() && done.insert(placed.model).second) {
      addSensors(placed.model, sensorsOf(readRobotType(type->second)), *fleet.robots[i].model, models);
    }
  }
  for (const auto& object : world.objects) {
    if (object.body.reflectivity != kReflectivity)
      models.reflectivities.emplace_back(object.name, object.body.reflectivity);
  }
  if (world.communication != Communication{}) models.radio = world.communication;
  return models;
}

}  // namespace robosim
