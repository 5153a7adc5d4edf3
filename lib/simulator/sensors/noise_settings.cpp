#include "sensors/noise_settings.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error_list.h"

namespace robosim {
namespace {

constexpr std::string_view kWithinNoise = "noise/";

std::string listOf(const SensorErrorSettings::Settings& settings) {
  std::string text;
  for (const auto& [name, value] : settings) {
    text +=
        (text.empty() ? "" : ", ") + name + (value.find(',') == std::string::npos ? " " + value : " (" + value + ")");
  }
  return text;
}

/// Whether a setting outside <noise> determines when a sensor measures. The rate of a camera is not an error.
bool isTime(const std::string& kind, const std::string& setting) {
  constexpr std::array<std::string_view, 8> kOfLaser{"sweep_s",       "interlace_s",  "latency_s",
                                                     "latency_std_s", "latency_tail", "latency_tail_factor",
                                                     "rate_hz",       "phase_s"};
  constexpr std::array<std::string_view, 2> kOfSonar{"firing_interval_s", "array"};
  const auto is_among = [&](const auto& names) {
    return std::find(names.begin(), names.end(), setting) != names.end();
  };
  return kind == "laser" || kind == "lidar" ? is_among(kOfLaser) : kind == "sonar" && is_among(kOfSonar);
}

std::string valueOf(const XmlElement& setting) {
  return setting.attributes.empty() ? setting.text : listOf(setting.attributes);
}

std::string kindOfSensor(const XmlElement& sensor) {
  if (sensor.name != "sensor") return sensor.name;
  for (const auto& child : sensor.children) {
    if (child.name == "type") return child.text;
  }
  return "";
}

}  // namespace

std::string SensorErrorSettings::text() const {
  if (isNone()) return "";
  std::string text = !has_noise ? "" : set.empty() ? "noise" : "noise " + set;
  if (!given.empty()) text += (text.empty() ? "" : "; ") + listOf(given);
  if (!defaults.empty()) text += "; by default " + listOf(defaults);
  return text;
}

SensorErrorSettings readErrorSettings(const XmlElement& sensor, const Mount& mount) {
  const std::string kind = kindOfSensor(sensor);
  const SensorType* type = sensorType(kind);
  if (!type) return {};
  SensorErrorSettings errors;
  SensorErrorSettings::Settings times;
  for (const auto& [name, value] : sensor.attributes) {
    if (name == "noise") {
      errors.has_noise = true;
      errors.set = value;
    } else if (isTime(kind, name)) {
      times.emplace_back(name, value);
    }
  }
  for (const auto& child : sensor.children) {
    if (isTime(kind, child.name)) times.emplace_back(child.name, child.text);
    if (child.name != "noise") continue;
    errors.has_noise = true;
    errors.given.insert(errors.given.end(), child.attributes.begin(), child.attributes.end());
    for (const auto& setting : child.children) errors.given.emplace_back(setting.name, valueOf(setting));
  }
  errors.given.insert(errors.given.end(), times.begin(), times.end());
  if (errors.isNone()) return errors;
  // Reading the element describes the settings that it does not have.
  ErrorList faults;
  XmlReader reader(sensor, "", faults);
  std::vector<XmlSetting> settings;
  reader.describeTo(settings);
  (sensor.name == "sensor" && type->read_2005 ? type->read_2005 : type->read)(reader, mount);
  times.clear();
  const bool has_table =
      std::any_of(errors.given.begin(), errors.given.end(), [](const auto& setting) { return setting.first == "at"; });
  for (const auto& setting : settings) {
    if (setting.default_text.empty()) continue;  // required within an element that need not exist, such as <at>
    if (has_table && (setting.name == "noise/std_m" || setting.name == "noise/std_per_m")) continue;
    if (errors.has_noise && setting.name.starts_with(kWithinNoise)) {
      errors.defaults.emplace_back(setting.name.substr(kWithinNoise.size()), setting.default_text);
    } else if (isTime(kind, setting.name)) {
      times.emplace_back(setting.name, setting.default_text);
    }
  }
  errors.defaults.insert(errors.defaults.end(), times.begin(), times.end());
  return errors;
}

}  // namespace robosim
