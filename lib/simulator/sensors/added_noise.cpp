#include "sensors/added_noise.h"

#include <algorithm>
#include <string>
#include <utility>

#include "sensors/registry.h"

namespace robosim {
namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// All errors of a kind of sensor. doc/fidelity.md gives the sources.
struct FullNoise {
  const char* kind;
  const char* set;      ///< the attribute `noise`; null for none
  Attributes settings;  ///< further attributes of the sensor; a 2005 <sensor> does not have them
  Attributes noise;     ///< attributes of <noise>
};

const std::vector<FullNoise>& fullNoises() {
  static const std::vector<FullNoise> all = {
      {"sonar", "polaroid", {{"beam_width_deg", "84"}, {"firing_interval_s", "0.04"}}, {}},
      {"laser", "lms200", {}, {{"drift_m", "0.01"}}},
      {"infrared", "gp2d12", {}, {{"dropout", "0.01"}}},
      {"heat", nullptr, {}, {{"lag_s", "1"}}},
      {"bumper", nullptr, {}, {{"chatter", "0.05"}}},
      {"odometry",
       nullptr,
       {},
       {{"diameter_ratio", "1.003"}, {"wheelbase_ratio", "1.01"}, {"turn_slip_s", "0.01"}, {"contact_slip", "0.3"}}},
      {"gnss", nullptr, {}, {{"dropout", "0.01"}}},
      {"encoders",
       nullptr,
       {},
       {{"diameter_ratio", "1.003"}, {"wheelbase_ratio", "1.01"}, {"turn_slip_s", "0.01"}, {"contact_slip", "0.3"}}},
      {"compass",
       nullptr,
       {},
       {{"offset_deg", "1"},
        {"hard_iron_deg", "5"},
        {"hard_iron_at_deg", "40"},
        {"soft_iron_deg", "2"},
        {"soft_iron_at_deg", "70"}}},
      {"battery", nullptr, {}, {{"drop_v_per_mps", "0.03"}, {"drop_v_per_radps", "0.03"}, {"std_v", "0.02"}}},
      {"beacons", nullptr, {}, {{"std_per_m", "0.01"}, {"dropout", "0.05"}}},
      {"range_and_bearing", nullptr, {}, {{"std_per_m", "0.02"}, {"dropout", "0.05"}}},
      {"camera",
       nullptr,
       {},
       {{"std", "4"}, {"exposure_std", "0.05"}, {"rolling_shutter_s", "0.03"}, {"k1", "-0.2"}, {"k2", "0.03"}}},
  };
  return all;
}

/// The kind of a sensor element: its name, or the type of a 2005 <sensor>.
std::string kindOf(const XmlElement& sensor) {
  if (sensor.name != "sensor") return sensor.name;
  for (const auto& child : sensor.children) {
    if (child.name == "type") return child.text;
  }
  for (const auto& [name, value] : sensor.attributes) {
    if (name == "type") return value;
  }
  return "";
}

bool hasNoise(const XmlElement& sensor) {
  return std::any_of(sensor.children.begin(), sensor.children.end(), [](const auto& c) { return c.name == "noise"; }) ||
         std::any_of(sensor.attributes.begin(), sensor.attributes.end(),
                     [](const auto& a) { return a.first == "noise"; });
}

void setAttribute(XmlElement& element, const std::string& name, const std::string& value) {
  std::erase_if(element.attributes, [&](const auto& attribute) { return attribute.first == name; });
  std::erase_if(element.children, [&](const auto& child) { return child.name == name; });
  element.attributes.emplace_back(name, value);
}

void addAllNoise(const std::string& kind, XmlElement& sensor) {
  XmlElement noise{"noise", "", {}, {}, {}};
  for (const auto& full : fullNoises()) {
    if (kind != full.kind) continue;
    if (full.set) setAttribute(sensor, "noise", full.set);
    if (sensor.name != "sensor") {
      for (const auto& [name, value] : full.settings) setAttribute(sensor, name, value);
    }
    noise.attributes = full.noise;
  }
  sensor.children.push_back(noise);
}

}  // namespace

void addNoise(AddedNoise added, std::vector<XmlElement>& sensors) {
  if (added == AddedNoise::none) return;
  bool has_odometry = false;
  for (auto& sensor : sensors) {
    const std::string kind = kindOf(sensor);
    has_odometry |= kind == "odometry";
    const SensorType* const type = sensorType(kind);
    if (!type || !type->has_noise || hasNoise(sensor)) continue;
    if (added == AddedNoise::all) {
      addAllNoise(kind, sensor);
    } else {
      sensor.add("noise");
    }
  }
  // A robot whose sensors are listed without odometry has an exact one.
  if (added == AddedNoise::all && !sensors.empty() && !has_odometry) {
    sensors.push_back({"odometry", "", {}, {}, {}});
    addAllNoise("odometry", sensors.back());
  }
}

}  // namespace robosim
