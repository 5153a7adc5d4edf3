#include "arcos/protocol/simulator_packets.h"

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"

namespace robosim::arcos {

namespace {

/// Flag of SIMSTAT: there is a position. Another one, which is never set, announces the error of odometry.
constexpr std::uint32_t kHasPosition = 2;
/// Quality of a position.
constexpr std::int32_t kGood = 100, kBad = 0, kNone = -1;

}  // namespace

std::string encode(const SimStat& stat) {
  ByteWriter bytes;
  bytes.add(std::uint8_t{0}).add(std::uint8_t{0});
  bytes.add(stat.position ? kHasPosition : std::uint32_t{0});
  bytes.add(stat.interval_ms).add(stat.desired_interval_ms).add(stat.measured_interval_ms);
  bytes.add(stat.x_mm).add(stat.y_mm).add(stat.z_mm).add(stat.heading_deg);
  const SimPosition position = stat.position.value_or(SimPosition{});
  bytes.add(position.latitude_e7).add(position.longitude_e7).add(position.altitude_cm);
  bytes.add(!stat.position ? kNone : position.is_valid ? kGood : kBad);
  bytes.add(std::int32_t{0}).add(std::int32_t{0}).add(std::int32_t{0});  // error of odometry
  return encode(packet_type::sim_stat, bytes.bytes());
}

std::optional<SimStat> decodeSimStat(const Packet& packet) {
  if (packet.id != packet_type::sim_stat) return std::nullopt;
  ByteReader bytes(packet.payload);
  SimStat stat;
  bytes.take<std::uint16_t>();
  const auto flags = bytes.take<std::uint32_t>();
  stat.interval_ms = bytes.take<std::uint16_t>();
  stat.desired_interval_ms = bytes.take<std::uint16_t>();
  stat.measured_interval_ms = bytes.take<std::uint16_t>();
  stat.x_mm = bytes.take<std::int32_t>();
  stat.y_mm = bytes.take<std::int32_t>();
  stat.z_mm = bytes.take<std::int32_t>();
  stat.heading_deg = bytes.take<std::int32_t>();
  SimPosition position;
  position.latitude_e7 = bytes.take<std::int32_t>();
  position.longitude_e7 = bytes.take<std::int32_t>();
  position.altitude_cm = bytes.take<std::int32_t>();
  position.is_valid = bytes.take<std::int32_t>() > 0;
  if (flags & kHasPosition) stat.position = position;
  if (bytes.endedEarly()) return std::nullopt;
  return stat;
}

std::string encode(const SimInfo& info) {
  ByteWriter bytes;
  bytes.addText(info.name).addText(info.version).add(std::uint32_t{0}).add(std::uint32_t{0});  // flags, devices
  return encode(packet_type::sim_info, bytes.bytes());
}

std::string encode(const SimMap& map) {
  constexpr std::size_t kFileMax = 128;
  ByteWriter bytes;
  bytes.add(std::uint8_t{map.is_by_user}).add(std::uint8_t{map.is_loaded}).addText(map.file.substr(0, kFileMax));
  return encode(packet_type::sim_map, bytes.bytes());
}

std::string decodeLoadMap(const Packet& packet) {
  ByteReader bytes(packet.payload);
  bytes.take<std::uint8_t>();  // type of the argument
  if (bytes.take<std::uint16_t>() != sim_operation::load_map) return {};
  const std::size_t length = bytes.take<std::uint16_t>();
  const std::string_view name = bytes.rest().substr(0, length);
  return std::string(name.substr(0, name.find('\0')));
}

std::string encodeSetPose(const SimPose& pose) {
  ByteWriter bytes;
  bytes.add(std::uint8_t{0}).add(pose.x_mm).add(pose.y_mm).add(pose.heading_deg);
  return encode(command::sim_set_pose, bytes.bytes());
}

std::optional<SimPose> decodeSetPose(const Packet& packet) {
  ByteReader bytes(packet.payload);
  bytes.take<std::uint8_t>();
  SimPose pose;
  pose.x_mm = bytes.take<std::int32_t>();
  pose.y_mm = bytes.take<std::int32_t>();
  pose.heading_deg = bytes.take<std::int32_t>();
  if (packet.id != command::sim_set_pose || bytes.endedEarly()) return std::nullopt;
  return pose;
}

}  // namespace robosim::arcos
