#pragma once
#include <array>
#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace robosim {

/// A page of the console without a browser: a WebSocket client (RFC 6455) for tests, over loopback and without TLS.
class TestPage {
 public:
  explicit TestPage(int port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
      close(socket_);
      throw std::runtime_error("no console listens at port " + std::to_string(port));
    }
    const std::string host = "127.0.0.1:" + std::to_string(port);
    write("GET / HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
          "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
          "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: robosim.remote.1\r\n\r\n");
  }
  ~TestPage() { close(socket_); }
  TestPage(const TestPage&) = delete;
  TestPage& operator=(const TestPage&) = delete;

  void hello(const std::string& token, const std::string& name = "Page") {
    send(R"({"type":"hello","protocol":1,"name":")" + name + R"(","token":")" + token + "\"}");
  }

  /// Sends a text message of at most 65,535 bytes.
  void send(const std::string& json) { sendFrame(0x81, json); }
  /// Sends a binary message of at most 65,535 bytes, which the console refuses.
  void sendBinary(const std::string& bytes) { sendFrame(0x82, bytes); }

  /// Reads the messages received by now. Acknowledges updates, of which only the number is kept.
  void receive() {
    std::array<char, 65536> piece;
    ssize_t got = 0;
    while ((got = recv(socket_, piece.data(), piece.size(), MSG_DONTWAIT)) > 0) {
      bytes_.append(piece.data(), static_cast<std::size_t>(got));
    }
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK)) is_closed = true;
    if (!is_upgraded_) {
      const auto end = bytes_.find("\r\n\r\n");
      if (end == std::string::npos) return;
      if (bytes_.find(" 101 ") > end) throw std::runtime_error("no WebSocket: " + bytes_.substr(0, end));
      bytes_.erase(0, end + 4);
      is_upgraded_ = true;
    }
    while (takeFrame()) {
    }
  }

  /// Whether a text message contains a text.
  bool has(std::string_view text) const { return countOf(text) > 0; }
  std::size_t countOf(std::string_view text) const {
    std::size_t count = 0;
    for (const auto& message : texts) count += message.find(text) != std::string::npos ? 1 : 0;
    return count;
  }

  std::vector<std::string> texts;  ///< messages
  std::size_t updates = 0;
  std::string why_closed;  ///< the console's reason
  bool is_closed = false;

 private:
  void write(const std::string& bytes) const {
    if (::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(bytes.size()) &&
        errno != EPIPE && errno != ECONNRESET) {
      throw std::runtime_error("the console accepts no more data");
    }
  }

  void sendFrame(unsigned char op, const std::string& bytes) const {
    constexpr unsigned char masked = 0x80, two_bytes = 126;
    std::string frame{static_cast<char>(op)};
    if (bytes.size() < two_bytes) {
      frame += static_cast<char>(masked | bytes.size());
    } else {
      frame += static_cast<char>(masked | two_bytes);
      frame += static_cast<char>(bytes.size() >> 8);
      frame += static_cast<char>(bytes.size());
    }
    write(frame + std::string(4, '\0') + bytes);  // a mask of zeros leaves the bytes as they are
  }

  bool takeFrame() {
    constexpr unsigned op_text = 1, op_binary = 2, op_close = 8;
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes_[i])); };
    if (bytes_.size() < 2) return false;
    std::size_t size = byte(1) & 127u, head = 2;
    const std::size_t size_bytes = size == 126 ? 2 : size == 127 ? 8 : 0;
    if (bytes_.size() < head + size_bytes) return false;
    if (size_bytes > 0) size = 0;
    for (std::size_t i = 0; i < size_bytes; ++i) size = size << 8 | byte(head++);
    if (bytes_.size() < head + size) return false;
    const auto op = byte(0) & 15u;
    if (op == op_text) texts.push_back(bytes_.substr(head, size));
    if (op == op_binary) send(R"({"type":"ack","number":)" + std::to_string(++updates) + "}");
    if (op == op_close) {
      why_closed = size > 2 ? bytes_.substr(head + 2, size - 2) : "";
      is_closed = true;
    }
    bytes_.erase(0, head + size);
    return true;
  }

  int socket_;
  std::string bytes_;
  bool is_upgraded_ = false;
};

}  // namespace robosim
