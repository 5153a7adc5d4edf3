#include "robosim/replay_words.h"

#include <cmath>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRawDAQ.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "recording/rawlog_reader.h"
#include "recording/recording_error.h"
#include "recording/unsensed.h"
#include "robosim/text.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationRawDAQ;

/// Longer lists go on as "…".
constexpr std::size_t kMostValues = 64;

std::string inWords(const mrpt::obs::CObservationRange& range) {
  std::string text;
  for (const auto& sensed : range) {
    text += text.empty() ? "" : " ";
    text += sensed.sensedDistance > range.maxSensorDistance ? "–" : fixed(sensed.sensedDistance, 2);
  }
  return text + " m";
}

std::string inWords(const mrpt::obs::CObservation2DRangeScan& scan) {
  float nearest = scan.maxRange;
  for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
    if (scan.getScanRangeValidity(i)) nearest = std::min(nearest, scan.getScanRange(i));
  }
  return std::to_string(scan.getScanSize()) + " ranges, the nearest " + fixed(nearest, 2) + " m";
}

std::string statusInWords(const CObservation& observation) {
  const RobotStatus status = statusFrom(observation);
  std::string text = "command " + robosim::inWords(status.command);
  if (status.command.by_driver) text += ", by a person";
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

/// A blob finder has seven numbers for each colour.
std::string blobsInWords(const std::vector<double>& numbers) {
  std::string text;
  for (std::size_t i = 0; i + 7 <= numbers.size(); i += 7) {
    text += (text.empty() ? "" : "; ") + fixed(numbers[i], 0) + " px";
    if (numbers[i] > 0) text += " round (" + fixed(numbers[i + 1], 1) + ", " + fixed(numbers[i + 2], 1) + ")";
  }
  return text;
}

template <typename Numbers>
std::string list(const std::string& name, const Numbers& numbers, int digits) {
  if (numbers.empty()) return "";
  std::string text = ", " + name;
  for (std::size_t i = 0; i < numbers.size() && i < kMostValues; ++i) text += " " + fixed(numbers[i], digits);
  return text + (numbers.size() > kMostValues ? " …" : "");
}

/// Digital inputs are a bumper's segments, in our recordings; in others, whatever was wired.
std::string inputsInWords(const CObservationRawDAQ& daq) {
  std::string text;
  if (!daq.DIN.empty()) {
    std::string on;
    for (std::size_t i = 0; i < 8 * daq.DIN.size() && i < kMostValues; ++i) {
      if ((daq.DIN[i / 8] >> (i % 8)) & 1U) on += " " + std::to_string(i);
    }
    text = ", on" + (on.empty() ? " none" : on);
  }
  text += list("inputs", daq.AIN_8bits, 0) + list("inputs", daq.AIN_16bits, 0) + list("inputs", daq.AIN_32bits, 0) +
          list("inputs", daq.AIN_float, 3) + list("inputs", daq.AIN_double, 3) + list("outputs", daq.AOUT_double, 3);
  return text.empty() ? classOf(daq) : text.substr(2);
}

std::string inWords(const CObservationRawDAQ& daq) {
  const std::string sensor = partsOf(daq.sensorLabel).sensor;
  try {
    if (sensor == kStatus) return statusInWords(daq);
    if (sensor == kInbox) return inboxInWords(daq);
  } catch (const RecordingError&) {
    // Somebody else's, with the same label.
  }
  if (sensor.ends_with(std::string("/") + kPoints)) return std::to_string(daq.AIN_float.size() / 3) + " points";
  const bool is_blobs = daq.DIN.empty() && !daq.AIN_double.empty() && daq.AIN_double.size() % 7 == 0;
  return is_blobs ? blobsInWords(daq.AIN_double) : inputsInWords(daq);
}

std::string unsafeWords(const CObservation& observation) {
  if (const auto* range = dynamic_cast<const mrpt::obs::CObservationRange*>(&observation)) return inWords(*range);
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation)) return inWords(*scan);
  if (const auto* heat = dynamic_cast<const mrpt::obs::CObservationGasSensors*>(&observation)) {
    if (!heat->m_readings.empty() && heat->m_readings[0].hasTemperature)
      return fixed(heat->m_readings[0].temperature, 2);
  }
  if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation)) {
    if (imu->has(mrpt::obs::IMU_YAW)) return "yaw " + fixed(imu->get(mrpt::obs::IMU_YAW) * 180 / M_PI, 1) + "°";
  }
  if (const auto* picture = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation)) {
    if (picture->image.isExternallyStored()) return "picture " + picture->image.getExternalStorageFile();
    return "picture of " + std::to_string(picture->image.getWidth()) + " × " +
           std::to_string(picture->image.getHeight()) + " px";
  }
  if (const auto* daq = dynamic_cast<const CObservationRawDAQ*>(&observation)) return inWords(*daq);
  if (const auto pose = poseIn(observation)) {
    return "x " + fixed(pose->x, 3) + " m, y " + fixed(pose->y, 3) + " m, heading " + fixed(pose->phi * 180 / M_PI, 1) +
           "°";
  }
  return classOf(observation);
}

}  // namespace

std::string inWords(const Command& command) {
  std::string text = fixed(command.speed_mps, 3) + " m/s, " + fixed(command.turn_radps, 3) + " rad/s";
  if (command.laser_pan_rad != 0) text += ", pan " + fixed(command.laser_pan_rad, 3) + " rad";
  if (command.activity == Activity::halted) text += ", halted";
  if (command.activity == Activity::found) text += ", found";
  return text;
}

std::string inWords(const CObservation& observation) { return printable(unsafeWords(observation)); }

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
