#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace robosim {

/// A minimal HTTP/2 client over loopback for frames that gRPC's client never sends (RFC 9113). Received data is
/// discarded, so that neither side blocks.
class Http2Peer {
 public:
  enum class Security { none, tls };

  /// Connects to "host:port". With TLS it offers `h2` and verifies no certificate.
  explicit Http2Peer(const std::string& address, Security security = Security::none);
  ~Http2Peer();
  Http2Peer(const Http2Peer&) = delete;
  Http2Peer& operator=(const Http2Peer&) = delete;

  /// Sends raw bytes. @return false once the server has closed the connection
  bool send(std::string_view bytes);
  /// Sends the connection preface and an empty SETTINGS frame.
  bool sendPreface();
  /// Encodes the headers of a call of `path` on a new stream, without a message. @return the bytes to send
  std::string headersOf(const std::string& path);
  /// HTTP/2 rapid reset (CVE-2023-44487): opens streams and cancels each at once.
  /// @return number of streams until the server closed the connection; `count` if it did not
  std::size_t resetStreams(std::size_t count, const std::string& path = "/robosim.v1.ControlPanel/GetStatus");
  /// Waits until the server closes the connection.
  void waitUntilClosed();
  bool isClosed();

 private:
  struct Wire;
  bool drain();

  std::unique_ptr<Wire> wire_;
  std::uint32_t next_stream_ = 1;
  bool is_closed_ = false;
};

/// A frame: nine bytes of header, and the payload.
std::string http2Frame(std::uint8_t type, std::uint8_t flags, std::uint32_t stream, std::string_view payload);

}  // namespace robosim
