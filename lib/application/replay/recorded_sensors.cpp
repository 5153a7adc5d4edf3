#include "replay/recorded_sensors.h"

#include "base/error_list.h"
#include "base/label.h"
#include "robots/world_source.h"

namespace robosim {

RecordedSensors::RecordedSensors(const std::vector<RobotInfo>& robots) {
  for (const auto& robot : robots) {
    for (const auto& sensor : *robot.sensors) sensors_[Label{robot.name, sensor.label, ""}.text()] = sensor;
  }
}

RecordedSensors RecordedSensors::of(const RunNote& note) {
  std::vector<RobotInfo> robots;
  try {
    if (note.world.text.empty()) return RecordedSensors({});  // too large to be recorded
    for (auto& robot : loadWorld(note.world, {}).fleet.robots) robots.push_back(std::move(robot.info));
  } catch (const ConfigError&) {
    // With sensors that this program does not have.
  }
  return RecordedSensors(robots);
}

const SensorInfo* RecordedSensors::find(const std::string& label) const {
  const auto found = sensors_.find(label);
  return found == sensors_.end() ? nullptr : &found->second;
}

}  // namespace robosim
