#include "replay/observation_csv.h"

#include <charconv>
#include <utility>
#include <variant>
#include <vector>

#include <mrpt/obs/CObservationRawDAQ.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "base/printable_text.h"
#include "base/text_table.h"
#include "recording/observed_numbers.h"
#include "recording/recording_error.h"
#include "recording/robot_status_record.h"
#include "replay/value_text.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationRawDAQ;

/// The shortest text that parses to the same number in its precision.
template <typename Number>
std::string exact(Number number) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

struct ExactText {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(auto number) const { return exact(number); }
};

/// A field, quoted if necessary; control characters are escaped.
std::string field(const std::string& text) {
  const std::string safe = printableText(text);
  if (safe.find_first_of(",\"") == std::string::npos) return safe;
  std::string quoted = "\"";
  for (const char c : safe) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

struct Row {
  std::vector<std::string> names, values;

  void add(const std::string& name, const std::string& value) {
    names.push_back(name);
    values.push_back(value);
  }
  template <typename Numbers>
  void addAll(const std::string& stem, const Numbers& numbers, const std::string& unit = "") {
    std::size_t i = 0;
    for (const auto number : numbers) add(stem + "_" + std::to_string(i++) + unit, exact(number));
  }
};

void addStatus(const CObservationRawDAQ& daq, Row& row) {
  const RobotStatus status = statusFrom(daq);
  row.add("speed_mps", exact(status.command.speed_mps));
  row.add("turn_radps", exact(status.command.turn_radps));
  row.add("pan_command_rad", exact(status.command.laser_pan_rad));
  row.add("activity", exact(static_cast<int>(status.command.activity)));
  row.add("by_driver", exact(static_cast<int>(status.command.by_driver)));
  row.add("pan_rad", exact(status.laser_pan_rad));
  row.add("stalled", exact(static_cast<int>(status.stalled)));
  row.add("too_far", exact(static_cast<int>(status.is_too_far)));
  row.add("has_won", exact(static_cast<int>(status.has_won)));
}

/// @returns whether the observation is of this sensor, a sensor of named quantities
bool addQuantities(const CObservationRawDAQ& daq, const SensorInfo* sensor, Row& row) {
  if (!sensor || sensor->quantities.empty() || sensor->quantities.size() != daq.AIN_double.size()) return false;
  for (std::size_t i = 0; i < daq.AIN_double.size(); ++i) {
    const auto& [name, unit] = sensor->quantities[i];
    row.add(field(name + (unit.empty() ? "" : "_" + unit)), exact(daq.AIN_double[i]));
  }
  return true;
}

void add(const CObservationRawDAQ& daq, const SensorInfo* described, Row& row) {
  const Label label = Label::parse(daq.sensorLabel);
  const std::string sensor = label.withinRobot();
  try {
    if (sensor == kStatus) return addStatus(daq, row);
  } catch (const RecordingError&) {
    // Another program's class with the same label.
  }
  if (sensor == kInbox) return row.add("messages", field(inWords(daq)));
  if (addQuantities(daq, described, row)) return;
  for (std::size_t i = 0; i < 8 * daq.DIN.size(); ++i) {
    row.add("din_" + std::to_string(i), (daq.DIN[i / 8] >> (i % 8)) & 1U ? "1" : "0");
  }
  if (label.part == kPoints) {
    const char* const axes[] = {"x", "y", "z"};
    for (std::size_t i = 0; i < daq.AIN_float.size(); ++i) {
      row.add(axes[i % 3] + ("_" + std::to_string(i / 3)) + "_m", exact(daq.AIN_float[i]));
    }
    return;
  }
  row.addAll("ain8", std::vector<int>(daq.AIN_8bits.begin(), daq.AIN_8bits.end()));
  row.addAll("ain16", std::vector<int>(daq.AIN_16bits.begin(), daq.AIN_16bits.end()));
  row.addAll("ain32", daq.AIN_32bits);
  row.addAll("ain_float", daq.AIN_float);
  row.addAll("ain", daq.AIN_double);
  row.addAll("aout", daq.AOUT_double);
}

Row rowOf(const CObservation& observation, const SensorInfo* sensor) {
  Row row;
  if (const auto numbers = numbersIn(observation)) {
    for (const auto& number : *numbers) row.add(number.fullName(), std::visit(ExactText(), number.value));
  } else if (const auto* truth = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation)) {
    const auto& pose = truth->pose.mean;
    row.addAll("position", std::vector<double>{pose.x(), pose.y(), pose.z()}, "_m");
    row.names = {"x_m", "y_m", "z_m"};
    row.add("heading_rad", exact(pose.yaw()));
  } else if (const auto* daq = dynamic_cast<const CObservationRawDAQ*>(&observation)) {
    add(*daq, sensor, row);
  } else {
    row.add("text", field(inWords(observation)));
  }
  return row;
}

std::string joined(const std::vector<std::string>& fields) {
  std::string line;
  for (const auto& one : fields) line += "," + one;
  return line + "\n";
}

}  // namespace

std::string ObservationCsv::lines(const CObservation& observation, double time_s, const SensorInfo* sensor) {
  const Row row = rowOf(observation, sensor);
  const std::string label = field(observation.sensorLabel);
  std::string text;
  const std::string names = "seconds,label" + joined(row.names);
  if (std::exchange(names_[label], names) != names) text = names;
  return text + fixed(time_s, 7) + "," + label + joined(row.values);
}

}  // namespace robosim
