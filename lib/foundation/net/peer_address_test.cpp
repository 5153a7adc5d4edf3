#include "net/peer_address.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(PeerOfName, IsTheClientOfARelayedConnection) {
  const PeerAddress peer{"fe80::1", 3000, true};
  EXPECT_EQ(peerOfName("unix-abstract:" + relayedPeerName(peer, 7)), peer.grpcName());
  EXPECT_EQ(peerOfName("unix-abstract:" + relayedPeerName({"127.0.0.1", 3000, false}, 7)), "ipv4:127.0.0.1:3000");
}

TEST(PeerOfName, HasNoInterfaceOfALinkLocalAddress) {
  const PeerAddress peer{"fe80::1", 3000, true};
  EXPECT_EQ(peerOfName("ipv6:%5Bfe80::1%25eth0%5D:3000"), peer.grpcName());
  EXPECT_EQ(peerOfName("ipv6:%5Bfe80::1%252%5D:3000"), peer.grpcName());
}

TEST(PeerOfName, IsGrpcsNameOfOthers) {
  for (const char* const name : {"ipv6:%5B::1%5D:3000", "ipv4:127.0.0.1:3000", "unix:/run/robosim", "ipv6:%5B", ""}) {
    EXPECT_EQ(peerOfName(name), name);
  }
}

}  // namespace
}  // namespace robosim
