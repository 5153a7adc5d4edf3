#include "arcos/protocol/gripper_packet.h"

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"

namespace robosim::arcos {
namespace {

/// Bits of the switches. Those of ends and paddles are 0 when the switch is pressed.
constexpr std::uint8_t kNotOpen = 0x01, kOuterBeam = 0x04, kInnerBeam = 0x08, kLeftFree = 0x10, kRightFree = 0x20;

}  // namespace

std::uint8_t GripperSwitches::byte() const {
  return static_cast<std::uint8_t>((is_closed ? kNotOpen : kLeftFree | kRightFree) | (outer_beam ? kOuterBeam : 0) |
                                   (inner_beam ? kInnerBeam : 0));
}

GripperSwitches GripperSwitches::from(std::uint8_t byte) {
  return {.is_closed = (byte & (kLeftFree | kRightFree)) == 0,
          .inner_beam = (byte & kInnerBeam) != 0,
          .outer_beam = (byte & kOuterBeam) != 0};
}

std::string encode(const GripperPacket& packet) {
  constexpr std::uint8_t kGraspTime = 0;
  return encode(packet_type::gripper,
                ByteWriter().add(packet.type).add(packet.switches.byte()).add(kGraspTime).bytes());
}

}  // namespace robosim::arcos
