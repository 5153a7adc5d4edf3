#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace robosim {

/// The version of the protocol that both ends must speak.
constexpr std::uint32_t kProtocolVersion = 1;

/// A peer's message makes no sense. What the peer is told, and the log: it costs that peer its connection, and nobody
/// else anything.
class WireError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A text of any length, fit for the status with which a call ends: cut short after 2000 bytes, for gRPC drops a longer
/// status and tells of that instead.
std::string fitForStatus(const std::string& text);

/// @throws WireError unless the peer speaks our version.
void checkProtocol(std::uint32_t version);

/// A text that came from a peer, fit for one line of a log: in quotes, what is not printable ASCII as '?', and cut
/// short after 60 bytes.
std::string inQuotes(std::string_view text);

}  // namespace robosim
