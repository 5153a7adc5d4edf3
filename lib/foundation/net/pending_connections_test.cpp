#include "net/pending_connections.h"

#include <array>
#include <deque>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace robosim {
namespace {

/// Accepts connections of its own over loopback.
class Loopback {
 public:
  Loopback() : listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address_;
    EXPECT_EQ(bind(listener_, reinterpret_cast<const sockaddr*>(&address_), size), 0);
    EXPECT_EQ(listen(listener_, 16), 0);
    EXPECT_EQ(getsockname(listener_, reinterpret_cast<sockaddr*>(&address_), &size), 0);
  }
  ~Loopback() {
    for (const int client : clients_) close(client);
    close(listener_);
  }
  Loopback(const Loopback&) = delete;
  Loopback& operator=(const Loopback&) = delete;

  /// The server's end, which the caller owns.
  int accept() {
    clients_.push_back(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    EXPECT_EQ(connect(clients_.back(), reinterpret_cast<const sockaddr*>(&address_), sizeof address_), 0);
    return accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  }

 private:
  const int listener_;
  sockaddr_in address_{};
  std::deque<int> clients_;
};

TEST(PendingConnections, OfAGateHaveAQuarterWhateverTheOthersHave) {
  Loopback loopback;
  PendingConnections full("viewers", 8), other("robots", 8);
  for (int i = 0; i < 8; ++i) ASSERT_NE(full.add(0, loopback.accept()), full.end());
  const auto first = other.add(0, loopback.accept());
  ASSERT_NE(first, other.end());
  const auto number = first->first;
  ASSERT_NE(other.add(0, loopback.accept()), other.end());
  EXPECT_NE(other.find(number), other.end()) << "8 / 4 connections are not closed for each other";
  ASSERT_NE(other.add(0, loopback.accept()), other.end());
  EXPECT_EQ(other.find(number), other.end()) << "the limit of all is reached";
}

TEST(PendingConnections, BeyondTheLimitReplaceTheOldest) {
  Loopback loopback;
  PendingConnections pending("robots", 2);
  const auto first = pending.add(0, loopback.accept())->first, second = pending.add(0, loopback.accept())->first;
  pending.add(0, loopback.accept());
  EXPECT_EQ(pending.find(first), pending.end());
  EXPECT_NE(pending.find(second), pending.end());
}

}  // namespace
}  // namespace robosim
