#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "net/hpack.h"

namespace robosim {

/// What a client has sent over an HTTP/2 connection (RFC 9113) before its first authorised call. Stores all bytes, and
/// parses each frame once. A client needs about ten frames and 1 kB before its first call; one that exceeds the limits
/// sends frames to occupy the server.
class ConnectionOpening {
 public:
  static constexpr int kMaxFrames = 64;
  static constexpr std::size_t kMaxBytes = 24 * 1024;
  /// Largest number of calls that a client may begin before it has received the server's own limit.
  static constexpr std::uint32_t kMaxCalls = 16;

  struct Call {
    std::uint32_t stream = 0;
    std::string path;                  ///< "/package.Service/Method"
    std::optional<std::string> token;  ///< value of `authorization`
    std::size_t message_bytes = 0;     ///< received in complete frames
    std::size_t partial_bytes = 0;     ///< received of an incomplete frame
    /// Whether the client has sent the prefix of a message. A call without one may be reset without any cost to the
    /// client.
    bool hasMessage() const { return message_bytes + partial_bytes >= 5; }
  };
  enum class Verdict {
    valid,
    no_http2,  ///< begins in another way: another protocol, or TLS at a port without TLS
    invalid,   ///< not as RFC 9113 requires
    excess,    ///< exceeds a limit
  };

  /// Adds received bytes. @return valid, or the first fault so far
  Verdict add(std::string_view bytes);
  /// Calls that have not been reset.
  const std::vector<Call>& calls() const { return calls_; }
  /// All bytes received.
  const std::string& bytes() const { return bytes_; }

 private:
  struct Frame {
    std::uint8_t type = 0, flags = 0;
    std::uint32_t stream = 0;
    std::size_t size = 0;  ///< of the payload
  };
  Verdict parse();
  Verdict take(const Frame& frame, std::string_view payload);
  Verdict takeHeaders(const Frame& frame, std::string_view payload);
  Verdict endHeaders();
  Call* callOf(std::uint32_t stream);

  std::string bytes_;
  std::size_t parsed_ = 0;  ///< bytes
  int frames_ = 0;
  HpackDecoder hpack_;
  std::optional<std::uint32_t> headers_stream_;  ///< whose header block is incomplete
  std::string block_;
  std::uint32_t last_stream_ = 0;
  std::vector<Call> calls_;
  Verdict verdict_ = Verdict::valid;
};

}  // namespace robosim
