#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include <grpcpp/support/status.h>

namespace robosim {

/// Version of the protocol; both sides must use the same.
constexpr std::uint32_t kProtocolVersion = 1;

/// An invalid message from a peer. The text is sent to the peer and logged; the peer's connection is closed, and other
/// clients are not affected.
class WireError : public std::runtime_error {
 public:
  explicit WireError(const std::string& what, grpc::StatusCode code = grpc::StatusCode::INVALID_ARGUMENT)
      : std::runtime_error(what), code_(code) {}
  grpc::StatusCode code() const { return code_; }

 private:
  grpc::StatusCode code_;
};

/// A text shortened to 2000 bytes, for the message of a grpc::Status: gRPC replaces longer messages.
std::string truncatedForStatus(const std::string& text);

/// @throws WireError unless the peer uses kProtocolVersion.
void checkProtocol(std::uint32_t version);

/// A text from a peer for a log line: in quotes, truncated after 60 bytes, with '?' for every byte that is not
/// printable ASCII.
std::string inQuotes(std::string_view text);

}  // namespace robosim
