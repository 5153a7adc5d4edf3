#include "recording/robot_status_record.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <mrpt/obs/CObservationRawDAQ.h>

#include "hardware/camera_head.h"
#include "hardware/led_color.h"
#include "recording/observations.h"
#include "recording/recording_error.h"

namespace robosim {
namespace {

using mrpt::math::TPoint3D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationRawDAQ;

/// Indices of the outputs and inputs of STATUS. Only an omnidirectional robot has kLateral. The outputs of a robot with
/// a camera's head end with those of CameraHeadColumn.
enum OutputColumn { kSpeed, kTurn, kPan, kActivity, kByDriver, kOutputs, kLateral = kOutputs, kOutputsOmni };
enum CameraHeadColumn { kHeadPan, kHeadTilt, kHeadZoom, kHeadPanSpeed, kHeadTiltSpeed };
constexpr std::size_t kHeadOutputs = kHeadTiltSpeed + 1;
/// Bits of kByDriver. The higher ones are the colour of the LEDs.
constexpr int kIsByDriver = 1, kIsEmergencyStop = 2, kIsGripping = 4, kLedColor = 8;
enum Input { kLaserPan, kStalled, kTooFar, kWon, kInputs };

std::shared_ptr<CObservationRawDAQ> rawDaq(const Label& label) {
  auto daq = CObservationRawDAQ::Create();
  daq->sensorLabel = label.text();
  return daq;
}

void append(std::vector<std::uint8_t>& bytes, const std::string& text) {
  const auto size = static_cast<std::uint32_t>(text.size());
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(size >> shift));
  bytes.insert(bytes.end(), text.begin(), text.end());
}

/// Template of an observation of which only the time and these lists of numbers change.
template <typename... Lists>
std::optional<SerializedTemplate> templateOf(CObservationRawDAQ& daq, Lists&... lists) {
  const auto bytes_of = [](const auto& value) { return std::as_bytes(std::span(value)); };
  return SerializedTemplate::of(daq, {bytes_of(std::span(&daq.timestamp, 1)), bytes_of(lists)...}, [&](int which) {
    // Numbers that do not occur elsewhere in the observation.
    daq.timestamp = toTimestamp({static_cast<std::uint64_t>(which) + 12345, 0.1});
    double next = 0.123 + 1000 * which;  // differs among the lists, too
    const auto fill = [&next](auto& list) {
      for (auto& number : list) number = static_cast<std::decay_t<decltype(number)>>(next++);
    };
    (fill(lists), ...);
  });
}

[[noreturn]] void refuse(const CObservation& observation, const std::string& why) {
  throw RecordingError("recorded observation \"" + observation.sensorLabel + "\" (" +
                       observation.GetRuntimeClass()->className + "): " + why + "; doc/rawlog.md describes the format");
}

const CObservationRawDAQ& asRawDaq(const CObservation& observation) {
  if (const auto* daq = dynamic_cast<const CObservationRawDAQ*>(&observation)) return *daq;
  refuse(observation, "the class should be mrpt::obs::CObservationRawDAQ");
}

/// Reads the texts that append() wrote.
class TextReader {
 public:
  explicit TextReader(const CObservationRawDAQ& from) : from_(from) {}

  bool atEnd() const { return at_ == from_.DIN.size(); }
  std::string next() {
    const auto take = [&](std::size_t size) {
      if (size > from_.DIN.size() - at_) refuse(from_, "a message is cut off");
      at_ += size;
      return from_.DIN.begin() + static_cast<std::ptrdiff_t>(at_ - size);
    };
    auto length = take(4);
    std::uint32_t size = 0;
    for (int shift = 0; shift < 32; shift += 8) size |= static_cast<std::uint32_t>(*length++) << shift;
    const auto text = take(size);
    return {text, text + size};
  }

 private:
  const CObservationRawDAQ& from_;
  std::size_t at_ = 0;
};

}  // namespace

RobotStatusRecord::RobotStatusRecord(const RobotInfo& robot) : robot_(robot.name), sensors_(robot.sensors) {
  for (const auto& sensor : *sensors_) {
    auto& axes = axes_.emplace_back();
    for (const auto& beam : sensor.beams) axes.push_back({originOf(beam), directionOf(beam)});
    auto points = rawDaq({robot_, sensor.label, kPoints});
    points->AIN_float.resize(3 * sensor.beams.size());
    points->AIN_channel_count = 3;
    points_.push_back({points, templateOf(*points, points->AIN_float)});
  }
  auto status = rawDaq({robot_, kStatus, ""});
  const std::size_t outputs = robot.type->drive.kind == DriveKind::omni ? kOutputsOmni : kOutputs;
  has_camera_head_ = cameraHeadIn(*sensors_).has_value();
  status->AOUT_double.resize(outputs + (has_camera_head_ ? kHeadOutputs : 0));
  status->AIN_double.resize(kInputs);
  status->AIN_channel_count = kInputs;
  status_ = {status, templateOf(*status, status->AOUT_double, status->AIN_double)};
}

void RobotStatusRecord::TemplatedObservation::write(ByteArchive& archive) {
  if (serialized) {
    serialized->append(archive);
  } else {
    archive << *observation;
  }
}

std::vector<CObservation::Ptr> RobotStatusRecord::of(const Readings& readings, const Command& command,
                                                     std::span<const std::uint8_t> kept) {
  fillStatus(readings, command);
  std::vector<CObservation::Ptr> all{status_.observation};
  forPoints(readings, kept, [&](const TemplatedObservation& points) { all.push_back(points.observation); });
  if (!readings.inbox.empty()) all.push_back(inboxOf(readings));
  return all;
}

void RobotStatusRecord::write(const Readings& readings, const Command& command, ByteArchive& archive,
                              std::span<const std::uint8_t> kept) {
  fillStatus(readings, command);
  status_.write(archive);
  forPoints(readings, kept, [&](TemplatedObservation& points) { points.write(archive); });
  if (!readings.inbox.empty()) archive << *inboxOf(readings);
}

void RobotStatusRecord::fillStatus(const Readings& readings, const Command& command) {
  CObservationRawDAQ& status = *status_.observation;
  status.timestamp = toTimestamp(readings.time);
  status.AOUT_double[kSpeed] = command.speed_mps;
  status.AOUT_double[kTurn] = command.turn_radps;
  status.AOUT_double[kPan] = command.laser_pan_rad;
  status.AOUT_double[kActivity] = static_cast<double>(command.activity);
  status.AOUT_double[kByDriver] = (command.by_driver ? kIsByDriver : 0) +
                                  (command.emergency_stop ? kIsEmergencyStop : 0) + (command.grip ? kIsGripping : 0) +
                                  static_cast<double>(kLedColor) * command.led_color;
  const std::size_t outputs = status.AOUT_double.size() - (has_camera_head_ ? kHeadOutputs : 0);
  if (outputs > kLateral) status.AOUT_double[kLateral] = command.lateral_mps;
  if (has_camera_head_) {
    const auto& [aim, pan_radps, tilt_radps] = *command.camera_head;
    double* const head = status.AOUT_double.data() + outputs;
    head[kHeadPan] = aim.pan_rad;
    head[kHeadTilt] = aim.tilt_rad;
    head[kHeadZoom] = aim.zoom;
    head[kHeadPanSpeed] = pan_radps;
    head[kHeadTiltSpeed] = tilt_radps;
  }
  status.AIN_double[kLaserPan] = readings.laser_pan_rad;
  status.AIN_double[kStalled] = readings.stalled ? 1 : 0;
  status.AIN_double[kTooFar] = readings.is_too_far ? 1 : 0;
  status.AIN_double[kWon] = readings.winner == robot_ ? 1 : 0;
}

template <typename Visit>
void RobotStatusRecord::forPoints(const Readings& readings, std::span<const std::uint8_t> kept, const Visit& visit) {
  for (std::size_t slot = 0; slot < sensors_->size(); ++slot) {
    if (slot < kept.size() && kept[slot]) continue;
    const auto* echoes = std::get_if<Echoes>(&readings.measurements[slot]);
    if (!echoes || isAlongAxes(slot, *echoes, (*sensors_)[slot].pans ? readings.laser_pan_rad : 0)) continue;
    CObservationRawDAQ& points = *points_[slot].observation;
    points.timestamp = toTimestamp(readings.time);
    for (std::size_t i = 0; i < echoes->size(); ++i) {
      const auto& at = (*echoes)[i].point_m;
      points.AIN_float[3 * i] = at.x;
      points.AIN_float[3 * i + 1] = at.y;
      points.AIN_float[3 * i + 2] = at.z;
    }
    visit(points_[slot]);
  }
}

CObservation::Ptr RobotStatusRecord::inboxOf(const Readings& readings) const {
  auto inbox = rawDaq({robot_, kInbox, ""});
  inbox->timestamp = toTimestamp(readings.time);
  for (const auto& message : readings.inbox) {
    append(inbox->DIN, message.from);
    append(inbox->DIN, message.text);
  }
  return inbox;
}

bool RobotStatusRecord::isAlongAxes(std::size_t slot, const Echoes& echoes, double pan_rad) const {
  const auto& axes = axes_[slot];
  const auto& beams = (*sensors_)[slot].beams;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const TPoint3D direction = pan_rad == 0 ? axes[i].direction : directionOf(beams[i], pan_rad);
    if (echoes[i].point_m != pointAlong(axes[i].origin, direction, echoes[i].range_m)) return false;
  }
  return true;
}

RobotStatus statusFrom(const CObservation& observation) {
  const auto& daq = asRawDaq(observation);
  const bool has_camera_head = daq.AOUT_double.size() >= kOutputs + kHeadOutputs;
  const std::size_t outputs = daq.AOUT_double.size() - (has_camera_head ? kHeadOutputs : 0);
  if ((outputs != kOutputs && outputs != kOutputsOmni) || daq.AIN_double.size() != kInputs) {
    refuse(observation, "it should hold 5, 6, 10 or 11 outputs and 4 inputs");
  }
  const double activity = daq.AOUT_double[kActivity];
  if (!(activity >= 0 && activity <= static_cast<double>(Activity::absent)))
    refuse(observation, "there is no such activity");
  const double by_driver = daq.AOUT_double[kByDriver];
  if (!(by_driver >= 0 && by_driver < kLedColor * (kLedColorMax + 1.0)))
    refuse(observation, "whether a person drives is not a sum of 1, 2, 4 and 8 times a colour of LEDs");
  RobotStatus status;
  status.command.speed_mps = daq.AOUT_double[kSpeed];
  status.command.turn_radps = daq.AOUT_double[kTurn];
  status.command.laser_pan_rad = static_cast<float>(daq.AOUT_double[kPan]);
  status.command.activity = static_cast<Activity>(activity);
  status.laser_pan_rad = static_cast<float>(daq.AIN_double[kLaserPan]);
  status.command.by_driver = (static_cast<int>(by_driver) & kIsByDriver) != 0;
  status.command.emergency_stop = (static_cast<int>(by_driver) & kIsEmergencyStop) != 0;
  status.command.grip = (static_cast<int>(by_driver) & kIsGripping) != 0;
  status.command.led_color = static_cast<std::uint32_t>(by_driver) / kLedColor;
  if (outputs > kLateral) status.command.lateral_mps = daq.AOUT_double[kLateral];
  status.has_camera_head = has_camera_head;
  if (has_camera_head) {
    const double* const head = daq.AOUT_double.data() + outputs;
    status.command.camera_head = CameraHeadCommand{
        {head[kHeadPan], head[kHeadTilt], head[kHeadZoom]}, head[kHeadPanSpeed], head[kHeadTiltSpeed]};
  }
  status.stalled = daq.AIN_double[kStalled] != 0;
  status.is_too_far = daq.AIN_double[kTooFar] != 0;
  status.has_won = daq.AIN_double[kWon] != 0;
  return status;
}

void restorePoints(const CObservation& observation, Echoes& echoes) {
  const auto& points = asRawDaq(observation).AIN_float;
  if (points.size() != 3 * echoes.size()) refuse(observation, "it should hold three numbers for each echo");
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    echoes[i].point_m = {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
  }
}

std::vector<RobotMessage> inboxFrom(const CObservation& observation, const std::string& to) {
  std::vector<RobotMessage> inbox;
  for (TextReader texts(asRawDaq(observation)); !texts.atEnd();) {
    const std::string from = texts.next();
    inbox.push_back({from, to, texts.next()});
  }
  return inbox;
}

}  // namespace robosim
