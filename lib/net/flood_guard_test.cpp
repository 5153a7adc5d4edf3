#include "net/flood_guard.h"

#include <array>
#include <cerrno>
#include <optional>
#include <string>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace robosim {
namespace {

constexpr std::size_t kFlood = 2 * flood_guard::kMaxUnansweredBytes;

/// Accepts TCP connections of this process.
class Listener {
 public:
  Listener() : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in any = addressOf("127.0.0.1");
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&any), sizeof any), 0);
    EXPECT_EQ(listen(socket_, 4), 0);
    socklen_t size = sizeof address_;
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address_), &size), 0);
  }
  ~Listener() { close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  static sockaddr_in addressOf(const char* host) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    inet_pton(AF_INET, host, &address.sin_addr);
    return address;
  }

  int socket_;
  sockaddr_in address_{};
};

/// A connection with both its ends. An address of its own lets the test ban it without effect on other tests.
class Connection {
 public:
  Connection(const Listener& listener, const std::string& host) : client_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in from = Listener::addressOf(host.c_str());
    EXPECT_EQ(bind(client_, reinterpret_cast<sockaddr*>(&from), sizeof from), 0);
    EXPECT_EQ(connect(client_, reinterpret_cast<const sockaddr*>(&listener.address_), sizeof listener.address_), 0);
    server_ = accept(listener.socket_, nullptr, nullptr);
    socklen_t size = sizeof from;
    EXPECT_EQ(getsockname(client_, reinterpret_cast<sockaddr*>(&from), &size), 0);
    peer_ = "ipv4:" + host + ":" + std::to_string(ntohs(from.sin_port));
    is_admitted_ = flood_guard::admit(server_);
  }
  ~Connection() {
    close(client_);
    close(server_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  const std::string& peer() const { return peer_; }
  bool isAdmitted() const { return is_admitted_; }
  /// @return whether all bytes have arrived
  bool send(std::size_t bytes) {
    std::array<char, 4096> data{};
    for (std::size_t sent = 0; sent < bytes; sent += data.size()) {
      if (::send(client_, data.data(), data.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(data.size())) return false;
      if (recv(server_, data.data(), data.size(), MSG_WAITALL) != static_cast<ssize_t>(data.size())) return false;
    }
    return true;
  }
  /// @return whether it was reset; false if it was closed
  bool waitUntilReset() {
    char byte = 0;
    return recv(client_, &byte, 1, 0) < 0 && errno == ECONNRESET;
  }

 private:
  int client_;
  int server_ = -1;
  std::string peer_;
  bool is_admitted_ = false;
};

TEST(FloodGuard, ResetsAConnectionThatSendsMuchAndReceivesNothingAndBansItsAddress) {
  const flood_guard::Wait wait;  // starts the guard's thread
  const Listener listener;
  Connection flooding(listener, "127.0.0.2");
  ASSERT_TRUE(flooding.isAdmitted());
  flooding.send(kFlood);
  EXPECT_TRUE(flooding.waitUntilReset());
  EXPECT_FALSE(Connection(listener, "127.0.0.2").isAdmitted());
  EXPECT_TRUE(Connection(listener, "127.0.0.3").isAdmitted());
}

TEST(FloodGuard, DoesNotCountWhatAConnectionSentWhileItWasExempt) {
  const flood_guard::Wait wait;
  const Listener listener;
  Connection worker(listener, "127.0.0.4");
  std::optional<flood_guard::Exemption> exemption(worker.peer());
  ASSERT_TRUE(worker.send(kFlood));
  exemption.reset();
  ASSERT_TRUE(worker.send(kFlood));  // results that were on their way
  // When the other connection has been reset, the guard has counted the bytes of both.
  Connection flooding(listener, "127.0.0.5");
  flooding.send(kFlood);
  EXPECT_TRUE(flooding.waitUntilReset());
  EXPECT_TRUE(worker.send(4096));
  EXPECT_TRUE(Connection(listener, "127.0.0.4").isAdmitted());
}

}  // namespace
}  // namespace robosim
