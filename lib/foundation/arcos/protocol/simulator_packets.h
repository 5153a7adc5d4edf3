#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "arcos/protocol/packet.h"

namespace robosim::arcos {

/// A position by satellites in SIMSTAT.
struct SimPosition {
  bool is_valid = false;                           ///< a fix; without one, the numbers are 0
  std::int32_t latitude_e7 = 0, longitude_e7 = 0;  ///< degrees times 10^7
  std::int32_t altitude_cm = 0;
  bool operator==(const SimPosition&) const = default;
};

/// What a simulator reports beyond what a robot knows (SIMSTAT).
struct SimStat {
  std::uint16_t interval_ms = 0;          ///< length of a time step
  std::uint16_t desired_interval_ms = 0;  ///< its duration at the requested speed
  std::uint16_t measured_interval_ms = 0;
  std::int32_t x_mm = 0, y_mm = 0, z_mm = 0;  ///< true pose
  std::int32_t heading_deg = 0;
  std::optional<SimPosition> position = {};  ///< nullopt: the map has no place on the earth
  bool operator==(const SimStat&) const = default;
};

std::string encode(const SimStat& stat);
std::optional<SimStat> decodeSimStat(const Packet& packet);

/// Identification of the simulator (SIMINFO), without devices.
struct SimInfo {
  std::string name;
  std::string version;
};
std::string encode(const SimInfo& info);

/// Answer to a request to load a map (SIM_MAP_CHANGED).
struct SimMap {
  bool is_by_user = false;  ///< an operator has loaded it
  bool is_loaded = false;   ///< false: the map that was in use before
  std::string file;         ///< of the map in use; at most 128 bytes are sent
};
std::string encode(const SimMap& map);

/// The operations of command::sim_control that RoboSim knows.
namespace sim_operation {
constexpr std::uint16_t load_map = 1, load_master_map = 2, request_info = 6;
}

/// A pose in the units of SIM_SET_POSE.
struct SimPose {
  std::int32_t x_mm = 0, y_mm = 0, heading_deg = 0;
};
/// The file that a request to load a map names: command::sim_control with sim_operation::load_map. Empty for none.
std::string decodeLoadMap(const Packet& command);

std::string encodeSetPose(const SimPose& pose);
std::optional<SimPose> decodeSetPose(const Packet& command);

}  // namespace robosim::arcos
