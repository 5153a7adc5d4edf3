#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "arcos/protocol/packet.h"

namespace robosim::arcos {

/// Positions of the wheels' encoders [ticks].
struct EncoderTicks {
  std::int32_t left = 0;
  std::int32_t right = 0;
  bool operator==(const EncoderTicks&) const = default;
};
std::string encode(const EncoderTicks& ticks);
std::optional<EncoderTicks> decodeEncoder(const Packet& packet);

/// Digital inputs and outputs, one byte each, and no analog inputs.
struct DigitalPorts {
  std::uint8_t in = 0xFF;
  std::uint8_t out = 0xFF;
  bool operator==(const DigitalPorts&) const = default;
};
std::string encode(const DigitalPorts& ports);

}  // namespace robosim::arcos
