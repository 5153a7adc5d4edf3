#include "arcos/protocol/sip.h"

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"

namespace robosim::arcos {

std::string encode(const Sip& sip) {
  ByteWriter bytes;
  bytes.add(sip.x).add(sip.y).add(sip.heading).add(sip.speed_left).add(sip.speed_right).add(sip.battery);
  bytes.add(sip.stall_left).add(sip.stall_right);
  bytes.add(std::int16_t{0});  // "control", unused
  bytes.add(sip.flags).add(sip.compass);
  bytes.add(static_cast<std::uint8_t>(sip.sonars.size()));
  for (const auto& sonar : sip.sonars) bytes.add(sonar.index).add(sonar.range);
  // ARIA takes the gripper's state from the byte after its own, the analog port.
  bytes.add(sip.gripper).add(sip.gripper).add(std::uint8_t{0});  // analog value
  bytes.add(sip.digital_in).add(sip.digital_out).add(sip.battery_decivolts).add(sip.charge_state);
  bytes.add(sip.turn_rate).add(sip.fault_flags);
  bytes.add(std::int16_t{0});  // lateral speed
  bytes.add(sip.temperature).add(sip.charge_percent);
  return encode(sip.is_moving ? packet_type::sip_moving : packet_type::sip_standing, bytes.bytes());
}

std::optional<Sip> decodeSip(const Packet& packet) {
  if ((packet.id & 0xF0) != 0x30) return std::nullopt;
  ByteReader bytes(packet.payload);
  Sip sip;
  sip.is_moving = packet.id == packet_type::sip_moving;
  sip.x = bytes.take<std::uint16_t>();
  sip.y = bytes.take<std::uint16_t>();
  sip.heading = bytes.take<std::int16_t>();
  sip.speed_left = bytes.take<std::int16_t>();
  sip.speed_right = bytes.take<std::int16_t>();
  sip.battery = bytes.take<std::uint8_t>();
  sip.stall_left = bytes.take<std::uint8_t>();
  sip.stall_right = bytes.take<std::uint8_t>();
  bytes.take<std::int16_t>();
  sip.flags = bytes.take<std::uint16_t>();
  sip.compass = bytes.take<std::uint8_t>();
  const auto count = bytes.take<std::uint8_t>();
  for (int i = 0; i < count && !bytes.endedEarly(); ++i) {
    const auto index = bytes.take<std::uint8_t>();
    sip.sonars.push_back({index, bytes.take<std::uint16_t>()});
  }
  if (bytes.endedEarly()) return std::nullopt;
  sip.battery_decivolts = sip.battery;
  const auto has = [&](std::size_t size) { return bytes.rest().size() >= size; };
  if (!has(3)) return sip;
  sip.gripper = bytes.take<std::uint8_t>();
  bytes.take<std::uint8_t>();  // analog port
  bytes.take<std::uint8_t>();
  if (has(1)) sip.digital_in = bytes.take<std::uint8_t>();
  if (has(1)) sip.digital_out = bytes.take<std::uint8_t>();
  if (has(2)) sip.battery_decivolts = bytes.take<std::uint16_t>();
  if (has(1)) sip.charge_state = bytes.take<std::uint8_t>();
  if (has(2)) sip.turn_rate = bytes.take<std::int16_t>();
  if (has(2)) sip.fault_flags = bytes.take<std::uint16_t>();
  if (has(2)) bytes.take<std::int16_t>();
  if (has(1)) sip.temperature = bytes.take<std::int8_t>();
  if (has(1)) sip.charge_percent = bytes.take<std::uint8_t>();
  return sip;
}

}  // namespace robosim::arcos
