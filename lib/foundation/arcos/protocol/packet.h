#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// @file
/// Packets of ARCOS, the protocol between the controller board of an ActivMedia (MobileRobots) robot and its programs,
/// over TCP or a serial line. doc/arcos.md describes the protocol as RoboSim speaks it.
namespace robosim::arcos {

/// A packet of either direction.
struct Packet {
  std::uint8_t id = 0;  ///< number of a command, or type of a packet of the robot
  std::string payload;
  bool operator==(const Packet&) const = default;
};

/// Largest payload: the length byte also counts the id and the checksum.
constexpr std::size_t kPayloadMax = 252;

/// Sum of the big-endian byte pairs modulo 2^16; a last single byte is combined by XOR.
std::uint16_t computeChecksum(std::string_view id_and_payload);

/// The packet's bytes: FA FB, length, id, payload, checksum.
/// @throws std::invalid_argument for a payload of more than kPayloadMax bytes
std::string encode(const Packet& packet);
std::string encode(std::uint8_t id, std::string_view payload = {});

/// Finds packets in a stream of bytes. After bytes that are no packet (noise, a wrong checksum, a truncated packet) it
/// continues at the next header, so that one fault loses the packets that it touches and no other.
class PacketReader {
 public:
  void add(std::string_view bytes) { buffer_ += bytes; }
  /// The next complete packet; nullopt until there are more bytes.
  std::optional<Packet> next();
  /// Gives up on a packet whose bytes have stopped arriving, so that next() looks for a header after the beginning of
  /// it. To be called kStalled after the last byte: a truncated packet would otherwise take the bytes of those that
  /// follow.
  void abandonIncomplete();
  static constexpr std::chrono::milliseconds kStalled{100};
  /// Number of bytes so far that were not part of a packet.
  std::size_t rejectedBytes() const { return rejected_; }
  /// Number of bytes that may become a packet. At most 257 after next() has returned nullopt.
  std::size_t pendingBytes() const { return buffer_.size() - begin_; }

 private:
  void reject(std::size_t count);

  std::string buffer_;
  std::size_t begin_ = 0;  ///< of the bytes that are not yet consumed
  std::size_t rejected_ = 0;
};

}  // namespace robosim::arcos
