#include "arcos/protocol/io_packets.h"

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"

namespace robosim::arcos {

std::string encode(const EncoderTicks& ticks) {
  return encode(packet_type::encoder, ByteWriter().add(ticks.left).add(ticks.right).bytes());
}

std::optional<EncoderTicks> decodeEncoder(const Packet& packet) {
  ByteReader bytes(packet.payload);
  EncoderTicks ticks;
  ticks.left = bytes.take<std::int32_t>();
  ticks.right = bytes.take<std::int32_t>();
  if (packet.id != packet_type::encoder || bytes.endedEarly()) return std::nullopt;
  return ticks;
}

std::string encode(const DigitalPorts& ports) {
  constexpr std::uint8_t kOne = 1, kNone = 0;
  return encode(packet_type::io, ByteWriter().add(kOne).add(ports.in).add(kOne).add(ports.out).add(kNone).bytes());
}

}  // namespace robosim::arcos
