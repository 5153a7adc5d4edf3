#include "replay/observation_row.h"

#include <mrpt/obs/CObservationRawDAQ.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "recording/observed_numbers.h"
#include "recording/recording_error.h"
#include "recording/robot_status_record.h"
#include "replay/value_text.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationRawDAQ;

/// Adds columns to a row.
class RowBuilder {
 public:
  explicit RowBuilder(ObservationRow& row) : row_(row) {}

  void add(const std::string& name, ColumnValue value) {
    row_.names.push_back(name);
    row_.values.push_back(std::move(value));
  }
  void addInteger(const std::string& name, std::int64_t value) { add(name, value); }
  /// Columns "<stem>_0", "<stem>_1", …
  template <typename Numbers>
  void addAll(const std::string& stem, const Numbers& numbers) {
    std::size_t i = 0;
    for (const auto number : numbers) {
      const std::string name = stem + "_" + std::to_string(i++);
      if constexpr (std::is_integral_v<std::remove_const_t<decltype(number)>>) {
        addInteger(name, number);
      } else {
        add(name, number);
      }
    }
  }

 private:
  ObservationRow& row_;
};

void addStatus(const CObservationRawDAQ& daq, RowBuilder& row) {
  const RobotStatus status = statusFrom(daq);
  row.add("speed_mps", status.command.speed_mps);
  row.add("turn_radps", status.command.turn_radps);
  row.add("pan_command_rad", status.command.laser_pan_rad);
  row.addInteger("activity", static_cast<int>(status.command.activity));
  row.addInteger("by_driver", status.command.by_driver ? 1 : 0);
  row.addInteger("emergency_stop", status.command.emergency_stop ? 1 : 0);
  row.addInteger("grip", status.command.grip ? 1 : 0);
  row.addInteger("led_color", static_cast<int>(status.command.led_color));
  if (status.has_camera_head) {
    const auto& [aim, pan_radps, tilt_radps] = *status.command.camera_head;
    row.add("camera_pan_command_rad", aim.pan_rad);
    row.add("camera_tilt_command_rad", aim.tilt_rad);
    row.add("camera_zoom_command", aim.zoom);
    row.add("camera_pan_radps", pan_radps);
    row.add("camera_tilt_radps", tilt_radps);
  }
  row.add("pan_rad", status.laser_pan_rad);
  row.addInteger("stalled", status.stalled ? 1 : 0);
  row.addInteger("too_far", status.is_too_far ? 1 : 0);
  row.addInteger("has_won", status.has_won ? 1 : 0);
}

/// @returns whether the observation is of this sensor, a sensor of named quantities
bool addQuantities(const CObservationRawDAQ& daq, const SensorInfo* sensor, RowBuilder& row) {
  if (!sensor || sensor->quantities.empty() || sensor->quantities.size() != daq.AIN_double.size()) return false;
  for (std::size_t i = 0; i < daq.AIN_double.size(); ++i) {
    const auto& [name, unit] = sensor->quantities[i];
    row.add(name + (unit.empty() ? "" : "_" + unit), daq.AIN_double[i]);
  }
  return true;
}

void add(const CObservationRawDAQ& daq, const SensorInfo* described, RowBuilder& row) {
  const Label label = Label::parse(daq.sensorLabel);
  const std::string sensor = label.withinRobot();
  try {
    if (sensor == kStatus) return addStatus(daq, row);
  } catch (const RecordingError&) {
    // Another program's class with the same label.
  }
  if (sensor == kInbox) return row.add("messages", inWords(daq));
  if (addQuantities(daq, described, row)) return;
  for (std::size_t i = 0; i < 8 * daq.DIN.size(); ++i) {
    row.addInteger("din_" + std::to_string(i), (daq.DIN[i / 8] >> (i % 8)) & 1U);
  }
  if (label.part == kPoints) {
    const char* const axes[] = {"x", "y", "z"};
    for (std::size_t i = 0; i < daq.AIN_float.size(); ++i) {
      row.add(axes[i % 3] + ("_" + std::to_string(i / 3)) + "_m", daq.AIN_float[i]);
    }
    return;
  }
  row.addAll("ain8", daq.AIN_8bits);
  row.addAll("ain16", daq.AIN_16bits);
  row.addAll("ain32", daq.AIN_32bits);
  row.addAll("ain_float", daq.AIN_float);
  row.addAll("ain", daq.AIN_double);
  row.addAll("aout", daq.AOUT_double);
}

}  // namespace

ObservationRow ObservationRow::of(const CObservation& observation, const SensorInfo* sensor) {
  ObservationRow result;
  RowBuilder row(result);
  if (const auto numbers = numbersIn(observation)) {
    for (const auto& number : *numbers) {
      row.add(number.fullName(), std::visit([](auto value) { return ColumnValue(value); }, number.value));
    }
  } else if (const auto* truth = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation)) {
    const auto& pose = truth->pose.mean;
    row.add("x_m", pose.x());
    row.add("y_m", pose.y());
    row.add("z_m", pose.z());
    row.add("heading_rad", pose.yaw());
  } else if (const auto* daq = dynamic_cast<const CObservationRawDAQ*>(&observation)) {
    add(*daq, sensor, row);
  } else {
    row.add("text", inWords(observation));
  }
  return result;
}

}  // namespace robosim
