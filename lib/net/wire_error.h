#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include <grpcpp/support/status.h>

namespace robosim {

/// The version of the protocol that both ends must speak.
constexpr std::uint32_t kProtocolVersion = 1;

/// A peer's message makes no sense. What the peer is told, and the log: it costs that peer its connection, and nobody
/// else anything.
class WireError : public std::runtime_error {
 public:
  explicit WireError(const std::string& what, grpc::StatusCode code = grpc::StatusCode::INVALID_ARGUMENT)
      : std::runtime_error(what), code_(code) {}
  grpc::StatusCode code() const { return code_; }

 private:
  grpc::StatusCode code_;
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
