#include "sensors/noise_settings.h"

#include <vector>

#include "base/error_list.h"

namespace robosim {
namespace {

std::string listOf(const std::vector<std::pair<std::string, std::string>>& settings) {
  std::string text;
  for (const auto& [name, value] : settings) text += (text.empty() ? "" : ", ") + name + " " + value;
  return text;
}

}  // namespace

std::string noiseTextOf(const XmlElement& sensor, const Mount& mount) {
  std::string text;
  for (const auto& [name, value] : sensor.attributes) {
    if (name == "noise") text = "noise " + value;
  }
  std::vector<std::pair<std::string, std::string>> given, defaults;
  for (const auto& child : sensor.children) {
    if (child.name != "noise") continue;
    if (text.empty()) text = "noise";
    for (const auto& [name, value] : child.attributes) given.emplace_back(name, value);
    for (const auto& setting : child.children) given.emplace_back(setting.name, setting.text);
  }
  std::string kind = sensor.name;
  if (kind == "sensor") {
    for (const auto& child : sensor.children) {
      if (child.name == "type") kind = child.text;
    }
  }
  const SensorType* type = sensorType(kind);
  if (text.empty() || !type) return "";
  // Reading the element describes the settings that it does not have.
  ErrorList errors;
  XmlReader reader(sensor, "", errors);
  std::vector<XmlSetting> settings;
  reader.describeTo(settings);
  (sensor.name == "sensor" && type->read_2005 ? type->read_2005 : type->read)(reader, mount);
  const std::string within = "noise/";
  for (const auto& setting : settings) {
    if (setting.name.starts_with(within))
      defaults.emplace_back(setting.name.substr(within.size()), setting.default_text);
  }
  if (!given.empty()) text += "; " + listOf(given);
  if (!defaults.empty()) text += "; by default " + listOf(defaults);
  return text;
}

}  // namespace robosim
