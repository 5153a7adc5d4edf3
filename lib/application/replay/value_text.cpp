#include "replay/value_text.h"

#include <cmath>
#include <variant>

#include <mrpt/core/format.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRawDAQ.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "base/angle_units.h"
#include "base/printable_text.h"
#include "base/text_table.h"
#include "hardware/measurement_fields.h"
#include "recording/observed_numbers.h"
#include "recording/rawlog_reader.h"
#include "recording/recording_error.h"
#include "recording/robot_status_record.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationRawDAQ;

/// The value, "–" for none.
std::string inWords(const ObservedNumber& number, int digits) {
  return std::visit(
      [&]<typename Value>(Value value) -> std::string {
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return "–";
        } else {
          return fixed(value, digits);
        }
      },
      number.value);
}

/// "x 1.000 m, heading 90.0°"; of a list of records only the values, "0.52 – 1.20 m"; with their indices if records may
/// be missing, "0: 5.00 2: 7.00 m".
std::string inWords(const ObservedNumbers& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const ObservedNumber& number = numbers[i];
    const bool is_continued = i + 1 < numbers.size() && number.index && numbers[i + 1].name == number.name;
    const std::string symbol = number.unit.symbol;
    const std::string unit = is_continued || symbol.empty() ? "" : " " + symbol;
    if (number.index) {
      const std::string index = number.has_gaps ? std::to_string(*number.index) + ": " : "";
      text += (text.empty() ? "" : " ") + index + inWords(number, 2) + unit;
    } else if (symbol == kRadian.symbol && std::holds_alternative<double>(number.value)) {
      text +=
          (text.empty() ? "" : ", ") + number.name + " " + fixed(toDegrees(std::get<double>(number.value)), 1) + "°";
    } else {
      text += (text.empty() ? "" : ", ") + number.name + " " + inWords(number, symbol == kDegree.symbol ? 7 : 3) + unit;
    }
  }
  return text;
}

std::string statusInWords(const CObservation& observation) {
  const RobotStatus status = statusFrom(observation);
  std::string text = "command " + robosim::inWords(status.command);
  if (status.command.by_driver) text += ", by a person";
  if (status.command.emergency_stop) text += ", emergency stop";
  if (status.command.grip) text += ", grip";
  if (status.command.led_color != 0) text += mrpt::format(", LEDs #%06x", status.command.led_color);
  if (status.stalled) text += "; stalled";
  if (status.is_too_far) text += "; too far to win";
  if (status.has_won) text += "; has won";
  return text;
}

std::string inboxInWords(const CObservation& observation) {
  std::string text;
  for (const auto& message : inboxFrom(observation, "")) {
    text += (text.empty() ? "" : "; ") + message.from + ": \"" + message.text + '"';
  }
  return text;
}

/// Numbers of a colour of a blob finder.
constexpr std::size_t kNumbersPerBlob = kFieldCount<Blobs>;

/// "gold 120 px at (3.5, 4.0); red 0 px"
std::string blobsInWords(const std::vector<double>& numbers, const std::vector<std::string>& colors) {
  std::string text;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double* const blob = &numbers[i * kNumbersPerBlob];
    text += (text.empty() ? "" : "; ") + colors[i] + " " + fixed(blob[0], 0) + " px";
    if (blob[0] > 0) text += " at (" + fixed(blob[1], 1) + ", " + fixed(blob[2], 1) + ")";
  }
  return text;
}

/// "co2 412.000 ppm, humidity 0.450"
std::string valuesInWords(const std::vector<double>& numbers, const std::vector<Quantity>& quantities) {
  std::string text;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const auto& [name, unit] = quantities[i];
    text += (text.empty() ? "" : ", ") + name + " " + fixed(numbers[i], 3) + (unit.empty() ? "" : " " + unit);
  }
  return text;
}

template <typename Numbers>
std::string list(const std::string& name, const Numbers& numbers, int digits) {
  if (numbers.empty()) return "";
  std::string text = ", " + name;
  for (const auto number : numbers) text += " " + fixed(number, digits);
  return text;
}

/// "(1.00, 2.00, 0.16) (…) m"
std::string pointsInWords(const std::vector<float>& numbers) {
  std::string text;
  for (std::size_t i = 0; i + 3 <= numbers.size(); i += 3) {
    text += (text.empty() ? "(" : " (") + fixed(numbers[i], 2) + ", " + fixed(numbers[i + 1], 2) + ", " +
            fixed(numbers[i + 2], 2) + ")";
  }
  return text + " m";
}

/// Digital inputs are bumper segments in RoboSim's recordings; in others their meaning is unknown.
std::string inputsInWords(const CObservationRawDAQ& daq) {
  std::string text;
  if (!daq.DIN.empty()) {
    std::string on;
    for (std::size_t i = 0; i < 8 * daq.DIN.size(); ++i) {
      if ((daq.DIN[i / 8] >> (i % 8)) & 1U) on += " " + std::to_string(i);
    }
    text = ", on" + (on.empty() ? " none" : on);
  }
  text += list("inputs", daq.AIN_8bits, 0) + list("inputs", daq.AIN_16bits, 0) + list("inputs", daq.AIN_32bits, 0) +
          list("inputs", daq.AIN_float, 3) + list("inputs", daq.AIN_double, 3) + list("outputs", daq.AOUT_double, 3);
  return text.empty() ? classOf(daq) : text.substr(2);
}

std::string inWords(const CObservationRawDAQ& daq, const SensorInfo* described) {
  const Label label = Label::parse(daq.sensorLabel);
  const std::string sensor = label.withinRobot();
  try {
    if (sensor == kStatus) return statusInWords(daq);
    if (sensor == kInbox) return inboxInWords(daq);
  } catch (const RecordingError&) {
    // Another program's class with the same label.
  }
  if (label.part == kPoints) return pointsInWords(daq.AIN_float);
  if (!described) return inputsInWords(daq);
  const auto& numbers = daq.AIN_double;
  const auto& colors = described->colors;
  const auto& quantities = described->quantities;
  if (!colors.empty() && numbers.size() == colors.size() * kNumbersPerBlob) return blobsInWords(numbers, colors);
  if (!quantities.empty() && numbers.size() == quantities.size()) return valuesInWords(numbers, quantities);
  return inputsInWords(daq);
}

std::string unsafeWords(const CObservation& observation, const SensorInfo* sensor) {
  if (const auto numbers = numbersIn(observation)) return numbers->empty() ? "–" : inWords(*numbers);
  if (const auto* picture = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation)) {
    if (picture->image.isExternallyStored()) return "picture " + picture->image.getExternalStorageFile();
    return "picture of " + std::to_string(picture->image.getWidth()) + " × " +
           std::to_string(picture->image.getHeight()) + " px";
  }
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation)) {
    return "picture of " + std::to_string(scan->cameraParams.ncols) + " × " + std::to_string(scan->cameraParams.nrows) +
           " px" + (scan->hasRangeImage ? " with depths" : "");
  }
  if (const auto* daq = dynamic_cast<const CObservationRawDAQ*>(&observation)) return inWords(*daq, sensor);
  if (const auto pose = poseIn(observation)) {
    return "x " + fixed(pose->x, 3) + " m, y " + fixed(pose->y, 3) + " m, heading " + fixed(toDegrees(pose->phi), 1) +
           "°";
  }
  return classOf(observation);
}

}  // namespace

std::string inWords(const Command& command) {
  std::string text = fixed(command.speed_mps, 3) + " m/s, " + fixed(command.turn_radps, 3) + " rad/s";
  if (command.lateral_mps != 0) text += ", " + fixed(command.lateral_mps, 3) + " m/s to the left";
  if (command.laser_pan_rad != 0) text += ", pan " + fixed(command.laser_pan_rad, 3) + " rad";
  if (const CameraAim& aim = command.camera_head->aim; aim != CameraAim{}) {
    text += ", camera to pan " + fixed(aim.pan_rad, 3) + " rad, tilt " + fixed(aim.tilt_rad, 3) + " rad, zoom " +
            fixed(aim.zoom, 3);
  }
  if (const auto& [aim, pan_radps, tilt_radps] = *command.camera_head; pan_radps != 0 || tilt_radps != 0) {
    text += ", camera at " + fixed(pan_radps, 3) + " and " + fixed(tilt_radps, 3) + " rad/s";
  }
  if (command.grip) text += ", gripper closed";
  if (command.led_color != 0) text += ", LEDs " + mrpt::format("0x%06x", command.led_color);
  if (command.emergency_stop) text += ", emergency stop";
  if (command.activity == Activity::halted) text += ", halted";
  if (command.activity == Activity::found) text += ", found";
  if (command.activity == Activity::absent) text += ", absent";
  return text;
}

std::string inWords(const CObservation& observation, const SensorInfo* sensor) {
  return printableText(unsafeWords(observation, sensor));
}

std::string classOf(const CObservation& observation) {
  const std::string name = observation.GetRuntimeClass()->className;
  const auto colon = name.rfind(':');
  return colon == std::string::npos ? name : name.substr(colon + 1);
}

std::optional<mrpt::math::TPose2D> poseIn(const CObservation& observation) {
  if (const auto* truth = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation)) {
    const auto& pose = truth->pose.mean;
    return mrpt::math::TPose2D(pose.x(), pose.y(), pose.yaw());
  }
  if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
    return odometry->odometry.asTPose();
  }
  return std::nullopt;
}

}  // namespace robosim
