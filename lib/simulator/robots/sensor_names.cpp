#include "robots/sensor_names.h"

#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "base/label.h"

namespace robosim {
namespace {

/// Reports a setting whose value an earlier sensor of the robot already has.
template <typename Value>
void checkUnique(XmlReader& sensor, const std::string& setting, const Value& value, std::map<Value, int>& line_of) {
  const auto [first, is_new] = line_of.emplace(value, sensor.line().number);
  if (is_new) return;
  sensor.errorAt(setting, "is taken already, by the sensor in line " + std::to_string(first->second) +
                              "; give each sensor of a robot " + (setting == "id" ? "an id" : "a label") +
                              " of its own");
}

}  // namespace

void checkSensorNames(std::vector<XmlReader>& sensors) {
  std::map<double, int> line_of_id;
  std::map<std::string, int> line_of_label;
  for (auto& sensor : sensors) {
    // Only the 2005 <sensor> has an id, and it has no label.
    if (sensor.name() == "sensor") {
      const auto id = sensor.has("id") ? parseNumber(sensor.word("id", "")) : std::nullopt;
      if (id) checkUnique(sensor, "id", *id, line_of_id);
    } else if (sensor.has("label")) {
      const std::string label = sensor.word("label", "");
      checkUnique(sensor, "label", label, line_of_label);
      if (const std::string fault = sensorLabelError(label); !fault.empty()) sensor.errorAt("label", fault);
    }
  }
}

void makeLabelsUnique(std::vector<SensorInfo>& sensors, const std::vector<bool>& labelled) {
  std::unordered_set<std::string> taken;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (labelled[i]) taken.insert(sensors[i].label);
  }
  std::unordered_map<std::string, int> next;  // next suffix to try for a label
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (labelled[i]) continue;
    const std::string label = sensors[i].label;
    int& number = next.try_emplace(label, 1).first->second;
    do {
      sensors[i].label = number == 1 ? label : label + "_" + std::to_string(number);
      ++number;
    } while (!taken.insert(sensors[i].label).second);
  }
}

}  // namespace robosim
