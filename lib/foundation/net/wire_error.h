#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "net/error_status.h"

namespace robosim {

/// Version of the protocol; both sides must use the same.
constexpr std::uint32_t kProtocolVersion = 1;

/// An invalid message from a peer. The text is sent to the peer and logged; the peer's connection is closed, and other
/// clients are not affected.
class WireError : public std::runtime_error {
 public:
  /// @param robot name of the robot concerned; empty for none
  explicit WireError(const std::string& what, v1::ErrorReason reason = v1::ERROR_REASON_INVALID_MESSAGE,
                     const std::string& robot = "")
      : std::runtime_error(what), status_(errorStatus(reason, what, robot)) {}
  /// With another status: the refusal by an access check.
  explicit WireError(const grpc::Status& status) : std::runtime_error(status.error_message()), status_(status) {}

  /// For the peer.
  const grpc::Status& status() const { return status_; }

 private:
  grpc::Status status_;
};

/// @throws WireError unless the peer uses kProtocolVersion.
void checkProtocol(std::uint32_t version);

/// A text from a peer for a log line: in quotes, truncated after 60 bytes, with '?' for every byte that is not
/// printable ASCII.
std::string inQuotes(std::string_view text);

}  // namespace robosim
