#include "remote/response_outbox.h"

#include <algorithm>

namespace robosim {

const std::array<ResponseOutbox::Request, 4> ResponseOutbox::kRequests{{
    {kHeat, RemoteType::req_heat, SensorKind::heat},
    {kLaser, RemoteType::req_laser, SensorKind::laser},
    {kSonar, RemoteType::req_sonar, SensorKind::sonar},
    {kAll, RemoteType::req_all, {}},
}};

void PortRobot::keepPictures() {
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    const auto* image = std::get_if<Image>(&readings().measurements[i]);
    if (image && !image->jpeg.empty()) pictures_[i] = {readings().time.step, image->jpeg};
  }
}

void PortRobot::dropPicturesBefore(std::uint64_t steps) {
  for (Picture& picture : pictures_) {
    if (picture.step && *picture.step + steps < readings().time.step) picture = {};
  }
}

ResponseOutbox::ResponseOutbox(const PortRobot& robot, RobotsWelcome welcome)
    : robot_(robot), welcome_(std::move(welcome)), sent_(robot.pictures().size()) {}

bool ResponseOutbox::request(RemoteType type) {
  const auto* const found =
      std::find_if(kRequests.begin(), kRequests.end(), [&](const Request& request) { return request.type == type; });
  if (found == kRequests.end()) return false;
  is_requested_[found->topic] = true;
  return true;
}

void ResponseOutbox::addState(bool is_driver) {
  v1::ControlResponse& message = add(kState, is_driver);
  if (welcome_) encode(*welcome_, *message.mutable_welcome());
}

void ResponseOutbox::addReadings(bool is_driver) {
  steps_since_all_ = is_requested_[kAll] ? 0 : std::min(kWatchingSteps, steps_since_all_ + 1);
  for (const auto& request : kRequests) {
    if (!is_requested_[request.topic]) continue;
    if (request.topic == kAll) {
      addAll(is_driver);
    } else {
      addSensor(request, is_driver);
    }
  }
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

v1::ControlResponse& ResponseOutbox::add(Topic topic, bool is_driver) {
  v1::ControlResponse& message = due_[topic];
  message.Clear();
  is_due_[topic] = true;
  RemoteState state = robot_.robot().state();
  state.is_yours = is_driver;
  encode(state, *message.mutable_state());
  return message;
}

void ResponseOutbox::addSensor(const Request& request, bool is_driver) {
  v1::ControlResponse::Reading& reading = *add(request.topic, is_driver).mutable_reading();
  reading.set_kind(requestedKind(request.type));
  reading.set_step(robot_.readings().time.step);
  const auto& sensors = *robot_.info().sensors;
  const auto found =
      std::find_if(sensors.begin(), sensors.end(), [&](const SensorInfo& s) { return s.kind == request.sensor; });
  if (found == sensors.end()) return;
  const auto slot = static_cast<std::size_t>(found - sensors.begin());
  reading.set_sensor(static_cast<std::uint32_t>(slot));
  encode(robot_.readings().measurements[slot], *reading.mutable_measurement());
  reading.mutable_measurement()->set_step(reading.step());
  reading.mutable_measurement()->set_is_new(true);
}

void ResponseOutbox::addAll(bool is_driver) {
  v1::ControlResponse::AllReadings& all = *add(kAll, is_driver).mutable_all();
  all.set_step(robot_.readings().time.step);
  encode(robot_.readings(), *all.mutable_readings());
  for (std::size_t i = 0; i < robot_.pictures().size(); ++i) {
    const PortRobot::Picture& picture = robot_.pictures()[i];
    if (picture.step <= sent_[i]) continue;
    v1::Measurement& measurement = *all.mutable_readings()->mutable_measurements(static_cast<int>(i));
    measurement.set_jpeg(picture.jpeg);
    measurement.set_step(*picture.step);
    measurement.set_is_new(true);
  }
}

}  // namespace robosim
