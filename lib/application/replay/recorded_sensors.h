#pragma once
#include <map>
#include <string>
#include <vector>

#include "hardware/robot_info.h"
#include "run/outputs/run_note.h"

namespace robosim {

/// Descriptions of the sensors in a recording, by the labels of their observations. An observation names neither its
/// kind of sensor, nor the quantities and colours that it measures.
class RecordedSensors {
 public:
  explicit RecordedSensors(const std::vector<RobotInfo>& robots);
  /// Those of the world of a recorded run; none where there is no world, or one that this program cannot read.
  static RecordedSensors of(const RunNote& note);

  /// null for an unknown label
  const SensorInfo* find(const std::string& label) const;

 private:
  std::map<std::string, SensorInfo> sensors_;
};

}  // namespace robosim
