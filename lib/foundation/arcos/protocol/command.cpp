#include "arcos/protocol/command.h"

#include <algorithm>

#include "arcos/protocol/bytes.h"

namespace robosim::arcos {
namespace {

// Types of arguments. The magnitude of a negative number is sent.
constexpr std::uint8_t kNotNegative = 0x3B;
constexpr std::uint8_t kNegative = 0x1B;
constexpr std::uint8_t kText = 0x2B;

}  // namespace

std::string encodeCommand(std::uint8_t id) { return encode(id); }

std::string encodeCommand(std::uint8_t id, int argument) {
  constexpr int kLargest = 0xFFFF;
  const int magnitude = std::min(std::abs(std::clamp(argument, -kLargest, kLargest)), kLargest);
  ByteWriter payload;
  payload.add(argument < 0 ? kNegative : kNotNegative).add(static_cast<std::uint16_t>(magnitude));
  return encode(id, payload.bytes());
}

std::string encodeCommand(std::uint8_t id, std::string_view text) {
  constexpr std::size_t kLongest = kPayloadMax - 3;
  text = text.substr(0, kLongest);
  ByteWriter payload;
  payload.add(kText).add(static_cast<std::uint8_t>(text.size()));
  return encode(id, payload.bytes() + std::string(text) + '\0');
}

std::optional<int> numberOf(const Packet& command) {
  ByteReader payload(command.payload);
  const auto type = payload.take<std::uint8_t>();
  const int magnitude = payload.take<std::uint16_t>();
  if (payload.endedEarly() || (type != kNotNegative && type != kNegative)) return std::nullopt;
  return type == kNegative ? -magnitude : magnitude;
}

std::optional<std::string> textOf(const Packet& command) {
  ByteReader payload(command.payload);
  const auto type = payload.take<std::uint8_t>();
  const std::size_t length = payload.take<std::uint8_t>();
  if (payload.endedEarly() || type != kText || payload.rest().size() < length) return std::nullopt;
  return std::string(payload.rest().substr(0, length));
}

}  // namespace robosim::arcos
