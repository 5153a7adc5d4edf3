#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "arcos/protocol/packet.h"

namespace robosim::arcos {

/// A standard information packet (SIP): the state that a robot sends every cycle. Numbers are as on the wire; units
/// that depend on the robot type are converted with Parameters.
struct Sip {
  struct Sonar {
    std::uint8_t index = 0;
    std::uint16_t range = 0;  ///< [mm]
    bool operator==(const Sonar&) const = default;
  };
  /// Bits of `flags`.
  static constexpr std::uint16_t kMotorsOn = 1, kSonarOn = 0x1E, kEstopPressed = 0x20, kCharging = 0x400;
  /// Bit of a wheel in `stall_left` and `stall_right`; the other bits are bumpers, rear and front, from bit 1.
  static constexpr std::uint8_t kStalled = 1;
  static constexpr std::int8_t kNoTemperature = -128;

  bool is_moving = false;
  std::uint16_t x = 0, y = 0;    ///< odometry [distance units], modulo 2^16; receivers use the low 15 bits
  std::int16_t heading = 0;      ///< [1/4096 turn], [-2048, 2047]
  std::int16_t speed_left = 0;   ///< [mm/s]
  std::int16_t speed_right = 0;  ///< [mm/s]
  std::uint8_t battery = 0;      ///< [0.1 V]
  std::uint8_t stall_left = 0;   ///< kStalled, and rear bumpers
  std::uint8_t stall_right = 0;  ///< kStalled, and front bumpers
  std::uint16_t flags = 0;
  std::uint8_t compass = 0;   ///< [2 degrees]
  std::vector<Sonar> sonars;  ///< at most 32
  std::uint8_t gripper = 0;   ///< GripperSwitches::byte(); 0 without a gripper
  std::uint8_t digital_in = 0xFF;
  std::uint8_t digital_out = 0xFF;
  std::uint16_t battery_decivolts = 0;  ///< the battery again, for more than 25.5 V
  std::uint8_t charge_state = 0;        ///< 0 none, 1 bulk, 2 overcharge, 3 float, 4 balance
  std::int16_t turn_rate = 0;           ///< [0.1 degree/s]
  std::uint16_t fault_flags = 0;
  std::int8_t temperature = kNoTemperature;  ///< [°C]
  std::uint8_t charge_percent = 0;           ///< 0: not known
  bool operator==(const Sip&) const = default;
};

std::string encode(const Sip& sip);
/// nullopt for a packet that is no SIP, or one that ends within the sonar readings or earlier. The fields after them
/// are optional, in order; those that are missing keep their defaults.
std::optional<Sip> decodeSip(const Packet& packet);

}  // namespace robosim::arcos
