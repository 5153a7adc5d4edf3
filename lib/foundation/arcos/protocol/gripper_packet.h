#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "arcos/protocol/packet.h"

namespace robosim::arcos {

/// Arguments of command::gripper.
namespace gripper_operation {
constexpr int open = 1, close = 2;        ///< the paddles
constexpr int store = 7, deploy = 8;      ///< close them and raise the lift; open them and lower it
constexpr int pressure = 16, carry = 17;  ///< followed by command::gripper_value
}  // namespace gripper_operation

/// A gripper without a lift, as its switches report it.
struct GripperSwitches {
  bool is_closed = false;
  bool inner_beam = false, outer_beam = false;  ///< light barriers between the paddles; true: interrupted
  bool operator==(const GripperSwitches&) const = default;

  /// As in a SIP and a gripper packet.
  std::uint8_t byte() const;
  static GripperSwitches from(std::uint8_t byte);
};

/// Answer to command::gripper_request.
struct GripperPacket {
  static constexpr std::uint8_t kNone = 0;
  static constexpr std::uint8_t kGeneralIo = 2;  ///< its switches are in each SIP, too
  std::uint8_t type = kNone;
  GripperSwitches switches;
};
std::string encode(const GripperPacket& packet);

}  // namespace robosim::arcos
