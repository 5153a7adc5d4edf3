#include "arcos/protocol/packet.h"

#include <stdexcept>

namespace robosim::arcos {
namespace {

constexpr std::string_view kHeader = "\xFA\xFB";
constexpr std::size_t kAround = 3;     ///< bytes counted by the length beside the payload: id, checksum
constexpr std::size_t kLengthEnd = 3;  ///< bytes up to and including the length

std::uint8_t byteAt(std::string_view bytes, std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); }

}  // namespace

std::uint16_t computeChecksum(std::string_view id_and_payload) {
  unsigned sum = 0;
  std::size_t i = 0;
  for (; i + 1 < id_and_payload.size(); i += 2) {
    sum = (sum + byteAt(id_and_payload, i) * 256u + byteAt(id_and_payload, i + 1)) & 0xFFFFu;
  }
  if (i < id_and_payload.size()) sum ^= byteAt(id_and_payload, i);
  return static_cast<std::uint16_t>(sum);
}

std::string encode(std::uint8_t id, std::string_view payload) {
  if (payload.size() > kPayloadMax) {
    throw std::invalid_argument("an ARCOS packet with " + std::to_string(payload.size()) + " bytes; at most " +
                                std::to_string(kPayloadMax) + " fit");
  }
  std::string bytes(kHeader);
  bytes.push_back(static_cast<char>(payload.size() + kAround));
  bytes.push_back(static_cast<char>(id));
  bytes += payload;
  const std::uint16_t checksum = computeChecksum(std::string_view(bytes).substr(kLengthEnd));
  bytes.push_back(static_cast<char>(checksum >> 8));
  bytes.push_back(static_cast<char>(checksum & 0xFF));
  return bytes;
}

std::string encode(const Packet& packet) { return encode(packet.id, packet.payload); }

void PacketReader::reject(std::size_t count) {
  begin_ += count;
  rejected_ += count;
}

std::optional<Packet> PacketReader::next() {
  for (;;) {
    const std::string_view rest = std::string_view(buffer_).substr(begin_);
    if (const auto header = rest.find(kHeader); header == std::string_view::npos) {
      const bool may_begin = !rest.empty() && rest.back() == kHeader.front();
      reject(rest.size() - (may_begin ? 1 : 0));
      break;
    } else if (header > 0) {
      reject(header);
      continue;
    }
    if (rest.size() < kLengthEnd) break;
    const std::size_t length = byteAt(rest, 2);
    if (length < kAround) {
      reject(1);
      continue;
    }
    if (rest.size() < kLengthEnd + length) break;
    const std::string_view checked = rest.substr(kLengthEnd, length - 2);
    const unsigned sent = byteAt(rest, length + 1) * 256u + byteAt(rest, length + 2);
    if (computeChecksum(checked) != sent) {
      reject(1);  // a true header may lie within
      continue;
    }
    Packet packet{byteAt(checked, 0), std::string(checked.substr(1))};
    begin_ += kLengthEnd + length;
    return packet;
  }
  buffer_.erase(0, begin_);
  begin_ = 0;
  return std::nullopt;
}

void PacketReader::abandonIncomplete() {
  if (pendingBytes() > 0) reject(1);
}

}  // namespace robosim::arcos
