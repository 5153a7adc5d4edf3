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
  Connection(const Listener& listener, const std::string& host, bool is_authorised = true)
      : client_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in from = Listener::addressOf(host.c_str());
    EXPECT_EQ(bind(client_, reinterpret_cast<sockaddr*>(&from), sizeof from), 0);
    EXPECT_EQ(connect(client_, reinterpret_cast<const sockaddr*>(&listener.address_), sizeof listener.address_), 0);
    server_ = accept(listener.socket_, nullptr, nullptr);
    socklen_t size = sizeof from;
    EXPECT_EQ(getsockname(client_, reinterpret_cast<sockaddr*>(&from), &size), 0);
    peer_ = "ipv4:" + host + ":" + std::to_string(ntohs(from.sin_port));
    flood_guard::admit(server_, is_authorised);
  }
  ~Connection() {
    close(client_);
    close(server_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  const std::string& peer() const { return peer_; }
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
};

/// The guard is global: a test ends the alarm that it has caused.
struct FloodGuard : testing::Test {
  ~FloodGuard() override { flood_guard::endAlarm(); }
  const flood_guard::Wait wait;  // starts the guard's thread
  const Listener listener;
};

TEST_F(FloodGuard, ResetsAConnectionThatSendsMuchAndReceivesNothingAndBansItsNetwork) {
  Connection flooding(listener, "127.0.2.2");
  flooding.send(kFlood);
  EXPECT_TRUE(flooding.waitUntilReset());
  EXPECT_TRUE(flood_guard::isAlarmed());
  EXPECT_TRUE(flood_guard::isBanned("127.0.2.0/24"));
  EXPECT_FALSE(flood_guard::isBanned("127.0.3.0/24"));
}

TEST_F(FloodGuard, DoesNotCountWhatAConnectionSentWhileItWasExempt) {
  Connection worker(listener, "127.0.4.4");
  std::optional<flood_guard::Exemption> exemption(worker.peer());
  ASSERT_TRUE(worker.send(kFlood));
  exemption.reset();
  ASSERT_TRUE(worker.send(kFlood));  // results that were on their way
  // When the other connection has been reset, the guard has counted the bytes of both.
  Connection flooding(listener, "127.0.5.5");
  flooding.send(kFlood);
  EXPECT_TRUE(flooding.waitUntilReset());
  EXPECT_TRUE(worker.send(4096));
  EXPECT_FALSE(flood_guard::isBanned("127.0.4.0/24"));
}

TEST_F(FloodGuard, ResetsTheConnectionsWithoutAnAuthorisedCallWhenAnAlarmStarts) {
  Connection unauthorised(listener, "127.0.6.6", false), authorised(listener, "127.0.6.7", false);
  EXPECT_EQ(flood_guard::unauthorised(), 2u);
  flood_guard::noteAuthorised(authorised.peer());
  EXPECT_EQ(flood_guard::unauthorised(), 1u);
  flood_guard::raiseAlarm("a test");
  EXPECT_TRUE(unauthorised.waitUntilReset());
  EXPECT_TRUE(authorised.send(4096));
  EXPECT_EQ(flood_guard::unauthorised(), 0u);
}

TEST_F(FloodGuard, ResetsAConnectionThatRepeatsRefusedCalls) {
  Connection guessing(listener, "127.0.8.8", false);
  for (int i = 0; i < flood_guard::kMaxRefusedCalls; ++i) flood_guard::noteRefused(guessing.peer());
  EXPECT_FALSE(flood_guard::isBanned("127.0.8.0/24"));
  flood_guard::noteRefused(guessing.peer());
  EXPECT_TRUE(guessing.waitUntilReset());
  EXPECT_TRUE(flood_guard::isBanned("127.0.8.0/24"));
}

TEST_F(FloodGuard, RaisesAnAlarmWhenManyConnectionsEndWithoutAnAuthorisedCall) {
  for (int i = 0; i < 100'000 && !flood_guard::isAlarmed(); ++i) {
    Connection(listener, "127.0.9.9", false);
    EXPECT_EQ(flood_guard::unauthorised(), 0u);
  }
  EXPECT_TRUE(flood_guard::isAlarmed());
}

TEST(PeerAddress, GroupsTheAddressesThatOneHostMayUse) {
  EXPECT_EQ((PeerAddress{"127.1.2.3", 4711, false}.network()), "127.1.2.0/24");
  EXPECT_EQ((PeerAddress{"192.0.2.7", 4711, false}.network()), "192.0.2.7");
  EXPECT_EQ((PeerAddress{"2001:db8:1:2:3:4:5:6", 4711, true}.network()), "2001:db8:1:2::/64");
}

TEST(PeerAddress, IsFoundInTheNameOfARelayedConnection) {
  const PeerAddress four{"192.0.2.7", 4711, false}, six{"2001:db8::6", 4711, true};
  EXPECT_EQ(peerOfName("unix-abstract:" + relayedPeerName(four, 3)), "ipv4:192.0.2.7:4711");
  EXPECT_EQ(peerOfName("unix-abstract:" + relayedPeerName(six, 4)), "ipv6:%5B2001:db8::6%5D:4711");
  EXPECT_EQ(peerOfName("ipv4:192.0.2.7:4711"), "ipv4:192.0.2.7:4711");
}

}  // namespace
}  // namespace robosim
