#include "robosim/check_errors.h"

#include <set>

#include "robots/robot_type_includes.h"
#include "sensors/noise_settings.h"

namespace robosim {
namespace {

/// Rows of the sensors with errors that a robot type or a robot describes.
void addNoise(const std::string& name, const std::vector<XmlElement>& sensors, const RobotModel& model, Rows& rows) {
  for (const auto& sensor : sensors) {
    const std::string noise = noiseTextOf(sensor, {1, model.radius_m, model.body.height_m, model.sensors, 0});
    if (!noise.empty()) rows.push_back({"  " + name, sensor.name + ": " + noise});
  }
}

}  // namespace

void addSensorErrors(const XmlElement& type, const RobotModel& model, Rows& rows) {
  addNoise("errors", sensorsOf(type), model, rows);
}

void addErrors(const World& world, const Fleet& fleet, const RobotTypes& types, Rows& rows) {
  std::set<std::string> listed;
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    const RobotPlacement& placed = world.robots[i];
    const auto type = types.find(placed.model);
    if (!placed.sensors.empty()) {
      addNoise(placed.name, placed.sensors, *fleet.robots[i].model, rows);
    } else if (type != types.end() && listed.insert(placed.model).second) {
      addNoise(placed.model, sensorsOf(readRobotType(type->second)), *fleet.robots[i].model, rows);
    }
  }
  const Communication& radio = world.communication;
  if (radio == Communication{}) return;
  const auto with = [](const char* name, double value) { return std::string(", ") + name + " " + toText(value); };
  rows.push_back({"communication", "range " + (radio.range_m ? toText(*radio.range_m) + " m" : "unlimited") +
                                       with("loss", radio.loss_probability) + with("wall_range", radio.wall_range_m) +
                                       " m" + with("wall_loss", radio.wall_loss) +
                                       with("burst_gap_s", radio.burst_gap_s) + with("burst_s", radio.burst_s) +
                                       with("burst_loss", radio.burst_loss) + with("delay_s", radio.delay_s) +
                                       with("rate_hz", radio.rate_hz)});
}

}  // namespace robosim
