#include "control/robot.h"

#include <algorithm>
#include <stdexcept>

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
  slot_of_kind_.fill(kNoSlot);
  for (std::size_t i = 0; i < std::min<std::size_t>(sensors.size(), kNoSlot); ++i) {
    Slot& of_kind = slot_of_kind_[static_cast<std::size_t>(sensors[i].kind)];
    if (of_kind == kNoSlot) of_kind = static_cast<Slot>(i);
    if (GripperState::isOf(sensors[i])) gripper_slot_ = static_cast<Slot>(i);
  }
  if (const auto head = cameraHeadIn(sensors); head && *head < kNoSlot) head_slot_ = static_cast<Slot>(*head);
}

const Measurement* Robot::measurement(SensorKind kind) const {
  const auto found = slotOf(kind);
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
  const auto found = slotOf(kind);
  return found ? std::get<Echoes>(readings().measurements[*found]) : kNoEchoes;
}

std::optional<double> Robot::scalar(SensorKind kind) const {
  const auto found = slotOf(kind);
  if (!found) return std::nullopt;
  return std::get<Scalar>(readings().measurements[*found]).value;
}

const std::vector<std::uint8_t>& Robot::bumper() const {
  const auto found = slotOf(SensorKind::bumper);
  return found ? std::get<Contacts>(readings().measurements[*found]).pressed : kNoContacts.pressed;
}

const Odometry& Robot::odometry() const {
  const auto found = slotOf(SensorKind::odometry);
  return found ? std::get<Odometry>(readings().measurements[*found]) : kAtStart;
}

const Image& Robot::image() const {
  const auto found = slotOf(SensorKind::camera);
  return found ? std::get<Image>(readings().measurements[*found]) : kNoImage;
}

const Blobs& Robot::blobs() const {
  const auto found = slotOf(SensorKind::blob_finder);
  return found ? std::get<Blobs>(readings().measurements[*found]) : kNoBlobs;
}

GripperState Robot::gripper() const {
  if (!hasGripper()) return {};
  return GripperState::from(std::get<Values>(readings().measurements[gripper_slot_]));
}

CameraAim Robot::cameraAim() const {
  if (!hasHead()) return {};
  return CameraAim::from(std::get<Values>(readings().measurements[head_slot_]));
}

void Robot::drive(double speed_mps, double turn_radps, double lateral_mps) {
  if (lateral_mps != 0 && info().type->drive.kind != DriveKind::omni) {
    throw std::invalid_argument("robot '" + info().name + "' has a drive of the type " +
                                nameOf(info().type->drive.kind) +
                                ", which has no lateral speed; use 0, or a robot with <drive type=\"omni\"/>");
  }
  const Command& last = command();
  if (last.activity != Activity::active) return;
  Command driven = last.keepingDevices();
  driven.speed_mps = speed_mps;
  driven.turn_radps = turn_radps;
  driven.lateral_mps = lateral_mps;
  hardware_.command(driven);
}

void Robot::stopInEmergency() {
  if (activity() != Activity::active) return;
  Command stopped = command().keepingDevices();
  stopped.emergency_stop = true;
  hardware_.command(stopped);
}

void Robot::panLaser(double pan_rad) {
  changeCommand([&](Command& changed) { changed.laser_pan_rad = static_cast<float>(pan_rad); });
}
void Robot::grip() {
  changeCommand([](Command& changed) { changed.grip = true; });
}
void Robot::release() {
  changeCommand([](Command& changed) { changed.grip = false; });
}
void Robot::setLeds(const std::array<float, 3>& rgb) {
  changeCommand([&](Command& changed) { changed.led_color = ledColor(rgb); });
}

void Robot::aimCamera(double pan_rad, double tilt_rad) {
  changeHead([&](CameraHeadCommand& head) { head.aim = {pan_rad, tilt_rad, head.aim.zoom}; });
}
void Robot::zoomCamera(double zoom) {
  changeHead([&](CameraHeadCommand& head) { head.aim.zoom = zoom; });
}
void Robot::limitCameraSpeed(double pan_radps, double tilt_radps) {
  changeHead([&](CameraHeadCommand& head) { head = {head.aim, pan_radps, tilt_radps}; });
}
void Robot::stopCamera() {
  changeHead([&](CameraHeadCommand& head) { head.aim = cameraAim(); });
}

template <typename Change>
void Robot::changeHead(const Change& change) {
  if (hasHead()) changeCommand([&](Command& changed) { change(changed.camera_head.edit()); });
}

template <typename Change>
void Robot::changeCommand(const Change& change) {
  Command changed = command();
  change(changed);
  changed.by_driver = false;
  hardware_.command(changed);
}

void Robot::halt(Activity why) {
  Command halted = command().keepingDevices();
  halted.activity = why;
  hardware_.command(halted);
}

}  // namespace robosim
