#pragma once
#include "environment/state_stream.h"
#include "hardware/led_color.h"

namespace robosim {

/// @file
/// A Command as bytes, in saved states and between the ranks of a run.

inline void writeCommand(const Command& command, StateWriter& out) {
  out.addNumber(command.speed_mps);
  out.addNumber(command.turn_radps);
  out.addNumber(command.laser_pan_rad);
  out.addNumber(static_cast<std::uint8_t>(command.activity));
  out.addNumber(std::uint8_t{command.by_driver});
  out.addNumber(std::uint8_t{command.emergency_stop});
  out.addNumber(std::uint8_t{command.grip});
  out.addNumber(command.led_color);
  out.addNumber(command.lateral_mps);
  const CameraHeadCommand& head = *command.camera_head;
  const bool has_head = head != CameraHeadCommand{};
  out.addNumber(std::uint8_t{has_head});
  if (!has_head) return;
  for (const double number : {head.aim.pan_rad, head.aim.tilt_rad, head.aim.zoom, head.pan_radps, head.tilt_radps}) {
    out.addNumber(number);
  }
}

/// @throws InvalidContents
inline Command readCommand(StateReader& in) {
  Command command;
  command.speed_mps = in.takeFinite();
  command.turn_radps = in.takeFinite();
  command.laser_pan_rad = in.takeNumber<float>();
  requireContents(std::isfinite(command.laser_pan_rad), "a pan angle is not finite");
  command.activity = in.takeActivity();
  command.by_driver = in.takeFlag();
  command.emergency_stop = in.takeFlag();
  command.grip = in.takeFlag();
  command.led_color = in.takeNumber<std::uint32_t>();
  requireContents(command.led_color <= kLedColorMax, "a colour of LEDs is no colour");
  command.lateral_mps = in.takeFinite();
  if (!in.takeFlag()) return command;
  CameraHeadCommand& head = command.camera_head.edit();
  for (double* number : {&head.aim.pan_rad, &head.aim.tilt_rad, &head.aim.zoom, &head.pan_radps, &head.tilt_radps}) {
    *number = in.takeFinite();
  }
  return command;
}

}  // namespace robosim
