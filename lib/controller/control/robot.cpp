#include "control/robot.h"

namespace robosim {
namespace {

const Echoes kNoEchoes;
const Contacts kNoContacts;
const Odometry kAtStart;
const Image kNoImage;
const Blobs kNoBlobs;

}  // namespace

Robot::Robot(Hardware& hardware) : hardware_(hardware) {
  const auto& sensors = *hardware.info().sensors;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const auto kind = static_cast<std::size_t>(sensors[i].kind);
    if (slot_of_kind_.size() <= kind) slot_of_kind_.resize(kind + 1, -1);
    if (slot_of_kind_[kind] < 0) slot_of_kind_[kind] = static_cast<int>(i);
    if (GripperState::isOf(sensors[i])) gripper_slot_ = i;
  }
}

std::optional<std::size_t> Robot::slot(SensorKind kind) const {
  const auto index = static_cast<std::size_t>(kind);
  if (index >= slot_of_kind_.size() || slot_of_kind_[index] < 0) return std::nullopt;
  return static_cast<std::size_t>(slot_of_kind_[index]);
}

const SensorInfo* Robot::sensor(SensorKind kind) const {
  const auto found = slot(kind);
  return found ? &(*info().sensors)[*found] : nullptr;
}

const Measurement* Robot::measurement(SensorKind kind) const {
  const auto found = slot(kind);
  return found ? &readings().measurements[*found] : nullptr;
}

const Measurement* Robot::measurement(const std::string& label) const {
  const auto& sensors = *info().sensors;
  for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
    if (sensors[slot].label == label) return &readings().measurements[slot];
  }
  return nullptr;
}

const Echoes& Robot::echoes(SensorKind kind) const {
  const auto found = slot(kind);
  return found ? std::get<Echoes>(readings().measurements[*found]) : kNoEchoes;
}

std::optional<double> Robot::scalar(SensorKind kind) const {
  const auto found = slot(kind);
  if (!found) return std::nullopt;
  return std::get<Scalar>(readings().measurements[*found]).value;
}

const std::vector<std::uint8_t>& Robot::bumper() const {
  const auto found = slot(SensorKind::bumper);
  return found ? std::get<Contacts>(readings().measurements[*found]).pressed : kNoContacts.pressed;
}

const Odometry& Robot::odometry() const {
  const auto found = slot(SensorKind::odometry);
  return found ? std::get<Odometry>(readings().measurements[*found]) : kAtStart;
}

const Image& Robot::image() const {
  const auto found = slot(SensorKind::camera);
  return found ? std::get<Image>(readings().measurements[*found]) : kNoImage;
}

const Blobs& Robot::blobs() const {
  const auto found = slot(SensorKind::blob_finder);
  return found ? std::get<Blobs>(readings().measurements[*found]) : kNoBlobs;
}

GripperState Robot::gripper() const {
  if (!gripper_slot_) return {};
  return GripperState::from(std::get<Values>(readings().measurements[*gripper_slot_]));
}

void Robot::drive(double speed_mps, double turn_radps) {
  const Command& last = command();
  if (last.activity != Activity::active) return;
  hardware_.command(
      {.speed_mps = speed_mps, .turn_radps = turn_radps, .laser_pan_rad = last.laser_pan_rad, .grip = last.grip});
}

void Robot::stopInEmergency() {
  if (activity() != Activity::active) return;
  hardware_.command({.laser_pan_rad = command().laser_pan_rad, .emergency_stop = true, .grip = command().grip});
}

void Robot::panLaser(double pan_rad) {
  Command panned = command();
  panned.laser_pan_rad = static_cast<float>(pan_rad);
  panned.by_driver = false;
  hardware_.command(panned);
}

void Robot::grip() { setGrip(true); }
void Robot::release() { setGrip(false); }
void Robot::setGrip(bool is_closed) {
  Command changed = command();
  changed.grip = is_closed;
  changed.by_driver = false;
  hardware_.command(changed);
}

void Robot::halt(Activity why) {
  hardware_.command({.laser_pan_rad = command().laser_pan_rad, .activity = why, .grip = command().grip});
}

}  // namespace robosim
