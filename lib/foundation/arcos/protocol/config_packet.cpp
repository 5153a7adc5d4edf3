#include "arcos/protocol/config_packet.h"

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"

namespace robosim::arcos {
namespace {

constexpr std::uint8_t u8(int value) { return static_cast<std::uint8_t>(value); }
constexpr std::uint16_t u16(int value) { return static_cast<std::uint16_t>(value); }

}  // namespace

std::string encode(const ConfigPacket& config) {
  ByteWriter bytes;
  bytes.addText(config.type).addText(config.subclass).addText(config.serial);
  bytes.add(u8(0));
  bytes.add(config.turn_top).add(config.speed_top).add(config.turn_accel_top).add(config.accel_top);
  bytes.add(u16(400));  // largest duty cycle of the motors
  bytes.addText(config.name);
  bytes.add(config.cycle_ms).add(u8(0)).add(u8(0));  // baud rates of the host and the auxiliary port
  bytes.add(u16(config.has_gripper));
  bytes.add(u16(config.has_front_sonar)).add(u8(config.has_rear_sonar));
  bytes.add(config.low_battery_decivolts);
  bytes.add(u16(16570));  // encoder ticks per turn of the robot
  bytes.add(config.watchdog_ms);
  bytes.add(u8(0)).add(u16(0)).add(u16(0));  // SIPs of another kind; stall value and count
  bytes.add(u16(0)).add(u16(0));             // joystick speeds
  bytes.add(config.turn_max).add(config.speed_max).add(config.turn_accel).add(config.turn_decel);
  bytes.add(u16(0)).add(u16(0)).add(u16(0));  // gains of the turn controller
  bytes.add(config.accel).add(config.decel);
  bytes.add(u16(0)).add(u16(0)).add(u16(0));  // gains of the speed controller
  bytes.add(config.front_bumpers).add(config.rear_bumpers);
  bytes.add(u8(0)).add(u8(40)).add(u8(0));              // charger; sonar cycle [ms]; automatic baud rate
  bytes.add(u8(config.has_gyro)).add(std::int16_t{0});  // drift factor
  bytes.add(u8(0)).add(u8(0));                          // baud rates of further ports
  bytes.add(config.ticks_per_mm);
  bytes.add(u16(0));  // shut-down voltage
  bytes.addText(config.firmware);
  bytes.add(u16(0)).add(u16(0)).add(u8(0));                           // gyro; delay of kinematics
  bytes.add(u16(0)).add(u16(0)).add(u16(0)).add(u16(0)).add(u16(0));  // lateral motion
  bytes.add(u16(0));                                                  // charge threshold
  return encode(packet_type::config, bytes.bytes());
}

std::optional<ConfigPacket> decodeConfig(const Packet& packet) {
  if (packet.id != packet_type::config) return std::nullopt;
  ByteReader bytes(packet.payload);
  const auto skip8 = [&] { bytes.take<std::uint8_t>(); };
  const auto skip16 = [&](int count) {
    for (int i = 0; i < count; ++i) bytes.take<std::uint16_t>();
  };
  ConfigPacket config;
  config.type = bytes.takeText();
  config.subclass = bytes.takeText();
  config.serial = bytes.takeText();
  skip8();
  config.turn_top = bytes.take<std::uint16_t>();
  config.speed_top = bytes.take<std::uint16_t>();
  config.turn_accel_top = bytes.take<std::uint16_t>();
  config.accel_top = bytes.take<std::uint16_t>();
  skip16(1);
  config.name = bytes.takeText();
  config.cycle_ms = bytes.take<std::uint8_t>();
  skip8();
  skip8();
  config.has_gripper = bytes.take<std::uint16_t>() != 0;
  config.has_front_sonar = bytes.take<std::uint16_t>() != 0;
  config.has_rear_sonar = bytes.take<std::uint8_t>() != 0;
  config.low_battery_decivolts = bytes.take<std::uint16_t>();
  skip16(1);
  config.watchdog_ms = bytes.take<std::uint16_t>();
  skip8();
  skip16(4);
  config.turn_max = bytes.take<std::uint16_t>();
  config.speed_max = bytes.take<std::uint16_t>();
  config.turn_accel = bytes.take<std::uint16_t>();
  config.turn_decel = bytes.take<std::uint16_t>();
  skip16(3);
  config.accel = bytes.take<std::uint16_t>();
  config.decel = bytes.take<std::uint16_t>();
  if (bytes.endedEarly()) return std::nullopt;
  skip16(3);
  config.front_bumpers = bytes.take<std::uint8_t>();
  config.rear_bumpers = bytes.take<std::uint8_t>();
  skip8();
  skip8();
  skip8();
  config.has_gyro = bytes.take<std::uint8_t>() == 1;
  skip16(1);
  skip8();
  skip8();
  config.ticks_per_mm = bytes.take<std::uint16_t>();
  skip16(1);
  config.firmware = bytes.takeText();
  return config;
}

}  // namespace robosim::arcos
