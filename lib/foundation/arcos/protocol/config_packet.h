#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "arcos/protocol/packet.h"

namespace robosim::arcos {

/// The configuration that a robot sends on request (CONFIGpac). Speeds in mm/s and degrees/s. "Top" is a limit of the
/// hardware, which becomes the limit of the program; "max", accelerations and decelerations are initial values, which
/// programs send back. Fields that RoboSim does not use are sent as constants.
struct ConfigPacket {
  std::string type = "Pioneer";
  std::string subclass;
  std::string serial = "SIM";  ///< "SIM" makes ARIA use the simulated laser
  std::string name;
  std::uint16_t turn_top = 0, speed_top = 0, turn_accel_top = 0, accel_top = 0;
  std::uint8_t cycle_ms = 100;
  bool has_gripper = false;
  bool has_front_sonar = false, has_rear_sonar = false;
  std::uint16_t low_battery_decivolts = 0;
  std::uint16_t watchdog_ms = 0;
  std::uint16_t turn_max = 0, speed_max = 0;
  std::uint16_t turn_accel = 0, turn_decel = 0;
  std::uint16_t accel = 0, decel = 0;
  std::uint8_t front_bumpers = 0, rear_bumpers = 0;
  bool has_gyro = false;  ///< an analogue one, whose readings the program integrates
  std::uint16_t ticks_per_mm = 0;
  std::string firmware = "S.robosim";
  bool operator==(const ConfigPacket&) const = default;
};

std::string encode(const ConfigPacket& config);
/// nullopt for another packet, and one that ends before the accelerations.
std::optional<ConfigPacket> decodeConfig(const Packet& packet);

}  // namespace robosim::arcos
