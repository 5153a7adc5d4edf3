#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "arcos/protocol/packet.h"

namespace robosim::arcos {

/// Numbers of the commands that RoboSim carries out or sends. Units: mm, mm/s, mm/s², degrees, counter-clockwise.
namespace command {
constexpr std::uint8_t sync0 = 0, sync1 = 1, sync2 = 2;  ///< before a session is open
constexpr std::uint8_t pulse = 0, open = 1, close = 2;   ///< afterwards
constexpr std::uint8_t enable = 4;                       ///< motors off or on
constexpr std::uint8_t seta = 5;                         ///< acceleration if positive, deceleration if negative
constexpr std::uint8_t setv = 6;                         ///< maximum speed
constexpr std::uint8_t seto = 7;                         ///< odometry to a pose: 3 × i16, default 0
constexpr std::uint8_t move = 8;                         ///< distance
constexpr std::uint8_t rotate = 9;                       ///< turn rate; the same as rvel
constexpr std::uint8_t setrv = 10;                       ///< maximum turn rate
constexpr std::uint8_t vel = 11;                         ///< speed
constexpr std::uint8_t head = 12;                        ///< heading in the odometry frame
constexpr std::uint8_t dhead = 13;                       ///< heading relative to the present one
constexpr std::uint8_t config = 18;                      ///< requests packet_type::config
constexpr std::uint8_t encoder = 19;                     ///< 0 stop, 1 once, 2 with every SIP: packet_type::encoder
constexpr std::uint8_t rvel = 21;                        ///< turn rate
constexpr std::uint8_t setra = 23;                       ///< turn acceleration if positive, deceleration if negative
constexpr std::uint8_t sonar = 28;                       ///< 0 off, 1 on
constexpr std::uint8_t stop = 29;
constexpr std::uint8_t digout = 30;           ///< digital outputs: mask in the high byte, values in the low one
constexpr std::uint8_t vel2 = 32;             ///< wheel speeds: left in the high byte, right in the low one
constexpr std::uint8_t gripper = 33;          ///< gripper_packet.h
constexpr std::uint8_t gripper_value = 36;    ///< after some operations; also old_laser_start
constexpr std::uint8_t gripper_request = 37;  ///< as encoder, for packet_type::gripper; also old_laser_end
constexpr std::uint8_t old_laser_enable = 35, old_laser_start = 36, old_laser_end = 37, old_laser_increment = 38;
constexpr std::uint8_t io_request = 40;  ///< as encoder, for packet_type::io
constexpr std::uint8_t tty2 = 42;        ///< bytes for the device at the auxiliary serial port AUX1
constexpr std::uint8_t getaux = 43;  ///< number of bytes that it has sent to send in packet_type::aux; 0: discard them
constexpr std::uint8_t bumpstall = 44;
constexpr std::uint8_t estop = 55, qstop = 57;  ///< stop at the maximum deceleration
constexpr std::uint8_t gyro = 58;               ///< 0 stop, 1 or 2 with every SIP: packet_type::gyro
constexpr std::uint8_t battery_info = 62;
constexpr std::uint8_t sim_set_pose = 224;  ///< true pose
constexpr std::uint8_t sim_reset = 225;     ///< true pose to the start, odometry to 0
constexpr std::uint8_t laser_enable = 230, laser_start = 231, laser_end = 232, laser_resolution = 233;
constexpr std::uint8_t sim_control = 236;
constexpr std::uint8_t sim_stat = 237;     ///< as encoder, for packet_type::sim_stat
constexpr std::uint8_t sim_message = 238;  ///< text for the log
constexpr std::uint8_t sim_exit = 239;
constexpr std::uint8_t battest = 250;  ///< simulated battery voltage [0.1 V]; 0: the true one
}  // namespace command

/// Types of the packets that a robot sends.
namespace packet_type {
constexpr std::uint8_t sip_standing = 0x32, sip_moving = 0x33;  ///< sip.h
constexpr std::uint8_t config = 0x20;                           ///< config_packet.h
constexpr std::uint8_t laser = 0x60, laser_extended = 0x61;     ///< laser_packets.h
constexpr std::uint8_t sim_stat = 0x62, sim_info = 0x63;        ///< simulator_packets.h
constexpr std::uint8_t sim_map = 0x66;                          ///< simulator_packets.h
constexpr std::uint8_t encoder = 0x90, io = 0xF0;               ///< io_packets.h
constexpr std::uint8_t gripper = 0xE0;                          ///< gripper_packet.h
constexpr std::uint8_t gyro = 0x98;                             ///< gyro_packet.h
constexpr std::uint8_t aux = 0xB0;                              ///< aux_port.h
}  // namespace packet_type

/// Encodes a command without an argument.
std::string encodeCommand(std::uint8_t id);
/// Encodes a command with a number, clamped to ±65535.
std::string encodeCommand(std::uint8_t id, int argument);
/// Encodes a command with a text of at most 249 bytes: its length, the text, NUL.
std::string encodeCommand(std::uint8_t id, std::string_view text);

/// The number of a command; nullopt if its payload is no number.
std::optional<int> numberOf(const Packet& command);
/// The text of a command; nullopt if its payload is no text.
std::optional<std::string> textOf(const Packet& command);

}  // namespace robosim::arcos
