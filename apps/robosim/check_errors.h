#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/text_table.h"
#include "base/xml_element.h"
#include "robots/fleet.h"
#include "robots/robot_types.h"
#include "sensors/noise_settings.h"
#include "world/world.h"

namespace robosim {

/// Error models of a world or a robot type, with the values of all settings, for `robosim check`.
struct ErrorModels {
  struct OfSensor {
    std::string of;      ///< a robot type, or a robot with sensors of its own; empty in the check of a type
    std::string sensor;  ///< its element: "laser"
    SensorErrorSettings settings;
  };
  std::vector<OfSensor> sensors;
  std::optional<Communication> radio;                          ///< nullopt for an exact one
  std::vector<std::pair<std::string, double>> reflectivities;  ///< of objects that do not have the default

  void addTo(Rows& rows) const;
  /// {"sensors": [{"of", "sensor", "noise", "settings": {…}}], "communication": {…} or null, "reflectivity": {…}}, with
  /// given values and defaults in `settings`.
  nlohmann::ordered_json json() const;
};

/// Errors of the sensors of a robot type. @param type the root element of its file, from readRobotType()
ErrorModels listErrorModels(const XmlElement& type, const RobotModel& model);
/// Errors of the sensors of each robot type, and of robots with sensors of their own, of the radio, and reflectivities.
ErrorModels listErrorModels(const World& world, const Fleet& fleet, const RobotTypes& types);

}  // namespace robosim
