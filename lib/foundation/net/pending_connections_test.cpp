#include "net/pending_connections.h"

#include <vector>

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Numbers = std::vector<PendingConnections::Number>;

PeerAddress at(const std::string& host) { return {.host = host, .port = 4711}; }

/// Pending connections, and the numbers of those that were closed.
struct Counted {
  explicit Counted(std::size_t max)
      : pending({"127.0.0.1:3000", "connections of a test", max},
                [this](PendingConnections::Number number) { closed.push_back(number); }) {}
  ~Counted() {
    for (const auto number : added) pending.remove(number);
  }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

  PendingConnections::Number add(const std::string& host = "192.0.2.1") {
    added.push_back(pending.add(at(host)).value());
    return added.back();
  }

  Numbers added, closed;
  PendingConnections pending;
};

TEST(PendingConnections, OfAnAcceptorHaveAQuarterWhateverTheOthersHave) {
  Counted full(8), other(8);
  for (int i = 0; i < 8; ++i) full.add();
  const auto first = other.add();
  other.add();
  EXPECT_EQ(other.closed, Numbers{}) << "8 / 4 connections are not closed for each other";
  other.add();
  EXPECT_EQ(other.closed, Numbers{first}) << "the limit of all is reached";
  EXPECT_EQ(full.closed, Numbers{});
}

TEST(PendingConnections, BeyondTheLimitReplaceTheOldest) {
  Counted two(2);
  const auto first = two.add(), second = two.add();
  two.add();
  EXPECT_EQ(two.closed, Numbers{first});
  two.add();
  EXPECT_EQ(two.closed, (Numbers{first, second}));
}

TEST(PendingConnections, BeyondTheLimitReplaceOnesOfTheNetworkWithTheMost) {
  Counted four(4);
  const auto alone = four.add("192.0.2.1");
  // One host may use all addresses of its /64 network.
  const auto first = [&] {
    const auto number = four.pending.add({.host = "2001:db8::1", .port = 1, .is_ipv6 = true}).value();
    four.added.push_back(number);
    return number;
  }();
  for (const char* host : {"2001:db8::2", "2001:db8::3", "2001:db8::4"}) {
    four.added.push_back(four.pending.add({.host = host, .port = 1, .is_ipv6 = true}).value());
  }
  EXPECT_EQ(four.closed, Numbers{first});
  four.pending.remove(alone);
}

TEST(PendingConnections, BeyondTheLimitReplaceFloodsFirst) {
  Counted three(3);
  const auto first = three.add(), second = three.add(), flood = three.add("192.0.2.2");
  three.pending.noteFlood(flood);
  three.add();
  EXPECT_EQ(three.closed, Numbers{flood});
  three.add();
  EXPECT_EQ(three.closed, (Numbers{flood, first}));
  three.pending.noteFlood(second);
  three.pending.remove(second);
  three.add();
  EXPECT_EQ(three.closed, (Numbers{flood, first})) << "one has been admitted";
}

}  // namespace
}  // namespace robosim
