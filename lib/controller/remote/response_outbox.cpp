#include "remote/response_outbox.h"

#include <algorithm>

#include "hardware/picture_file.h"

namespace robosim {

namespace {

/// Copies a received message without its pictures, which PortRobot has.
void forward(const v1::RobotReadings& received, v1::RobotReadings& out) {
  for (const auto& measurement : received.measurements()) {
    v1::Measurement& copy = *out.add_measurements();
    if (measurement.jpeg().empty() && measurement.raw_picture().empty()) copy = measurement;
  }
  out.set_stalled(received.stalled());
  out.set_laser_pan_rad(received.laser_pan_rad());
  out.set_is_too_far(received.is_too_far());
  *out.mutable_inbox() = received.inbox();
}

}  // namespace

void PortRobot::keepPictures() {
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    const auto* image = std::get_if<Image>(&readings().measurements[i]);
    if (image && !image->isEmpty()) pictures_[i] = {readings().time.step, *image};
  }
}

void PortRobot::dropPicturesBefore(std::uint64_t steps) {
  for (Picture& picture : pictures_) {
    if (picture.step && *picture.step + steps < readings().time.step) picture = {};
  }
}

ResponseOutbox::ResponseOutbox(const PortRobot& robot, RobotsWelcome welcome)
    : robot_(robot), welcome_(std::move(welcome)), sent_(robot.pictures().size()) {}

bool ResponseOutbox::request(OrderType type) {
  if (rowOf(type).rule != OrderRule::request) return false;
  is_requested_[kFirstReading + readingIndex(type)] = true;
  return true;
}

void ResponseOutbox::addState(bool is_driver) {
  v1::ControlResponse& message = add(kState, is_driver);
  if (welcome_) encode(*welcome_, *message.mutable_welcome());
}

void ResponseOutbox::addReadings(bool is_driver, const v1::RobotReadings* received) {
  steps_since_all_ = is_requested_[kAll] ? 0 : std::min(kWatchingSteps, steps_since_all_ + 1);
  for (std::size_t reading = 0; reading < kReadings; ++reading) {
    if (is_requested_[kFirstReading + reading]) addSensor(reading, is_driver, received);
  }
  if (is_requested_[kAll]) addAll(is_driver, received);
}

bool ResponseOutbox::isEmpty() const { return std::find(is_due_.begin(), is_due_.end(), true) == is_due_.end(); }

void ResponseOutbox::takeNext(v1::ControlResponse& out) {
  const auto* const next = std::find(is_due_.begin(), is_due_.end(), true);
  const auto topic = static_cast<std::size_t>(next - is_due_.begin());
  out.Swap(&due_[topic]);
  is_due_[topic] = is_requested_[topic] = false;
  if (topic == kState) welcome_.reset();
  if (out.has_reading() && out.reading().has_sensor()) {
    noteSent(*out.mutable_reading()->mutable_measurement(), out.reading().sensor());
  }
  if (!out.has_all()) return;
  auto& measurements = *out.mutable_all()->mutable_readings()->mutable_measurements();
  for (int i = 0; i < measurements.size(); ++i) noteSent(measurements[i], static_cast<std::size_t>(i));
}

/// Marks a measurement that this remote control has received as not new. Called when a message is taken: only then the
/// order of the messages is known.
void ResponseOutbox::noteSent(v1::Measurement& measurement, std::size_t sensor) {
  if (!measurement.is_new()) return;  // contains nothing
  measurement.set_is_new(!sent_[sensor] || measurement.step() > *sent_[sensor]);
  sent_[sensor] = measurement.step();
}

v1::ControlResponse& ResponseOutbox::add(std::size_t topic, bool is_driver) {
  v1::ControlResponse& message = due_[topic];
  message.Clear();
  is_due_[topic] = true;
  *message.mutable_state() = robot_.robot().state();
  message.mutable_state()->set_is_yours(is_driver);
  return message;
}

void ResponseOutbox::addSensor(std::size_t index, bool is_driver, const v1::RobotReadings* received) {
  const SensorKind kind = readingRow(index).sensor;
  v1::ControlResponse::Reading& reading = *add(kFirstReading + index, is_driver).mutable_reading();
  reading.set_kind(nameOf(kind));
  reading.set_step(robot_.readings().time.step);
  const auto& sensors = *robot_.info().sensors;
  const auto found = std::find_if(sensors.begin(), sensors.end(), [&](const SensorInfo& s) { return s.kind == kind; });
  if (found == sensors.end()) return;
  const auto slot = static_cast<std::size_t>(found - sensors.begin());
  reading.set_sensor(static_cast<std::uint32_t>(slot));
  v1::Measurement& measurement = *reading.mutable_measurement();
  if (received) {
    measurement = received->measurements(static_cast<int>(slot));
  } else {
    encode(robot_.readings().measurements[slot], measurement);
  }
  measurement.set_step(reading.step());
  measurement.set_is_new(true);
}

void ResponseOutbox::addAll(bool is_driver, const v1::RobotReadings* received) {
  v1::ControlResponse::AllReadings& all = *add(kAll, is_driver).mutable_all();
  all.set_step(robot_.readings().time.step);
  if (received) {
    forward(*received, *all.mutable_readings());
  } else {
    encode(robot_.readings(), *all.mutable_readings());
  }
  for (std::size_t i = 0; i < robot_.pictures().size(); ++i) {
    const PortRobot::Picture& picture = robot_.pictures()[i];
    v1::Measurement& measurement = *all.mutable_readings()->mutable_measurements(static_cast<int>(i));
    if (!measurement.raw_picture().empty()) measurement.Clear();  // remote controls show files
    if (picture.step <= sent_[i]) continue;
    measurement.set_jpeg(jpegOf(picture.image));
    measurement.set_step(*picture.step);
    measurement.set_is_new(true);
  }
}

}  // namespace robosim
