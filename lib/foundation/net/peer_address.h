#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <grpcpp/grpcpp.h>

namespace robosim {

/// Address of the other end of a TCP connection.
struct PeerAddress {
  std::string host;  ///< numeric; an IPv4 address that an IPv6 socket has accepted is an IPv4 address
  std::uint16_t port = 0;
  bool is_ipv6 = false;
  bool operator==(const PeerAddress&) const = default;

  /// @return nullopt for a descriptor that is not a connected TCP socket
  static std::optional<PeerAddress> of(int connection);

  /// As grpc::ServerContext::peer() names it: "ipv4:10.0.0.5:41234", "ipv6:%5Bfe80::1%5D:41234".
  std::string grpcName() const;
  /// The addresses that one host may use at will: the /64 network of an IPv6 address; the /24 network of an address in
  /// 127.0.0.0/8, all of which are of this machine; any other IPv4 address alone. "2001:db8::/64", "127.0.0.0/24",
  /// "192.0.2.7".
  std::string network() const;
};

/// Name of a local socket that stands for a connection whose TLS this process terminates (net/tls_relay.h), without the
/// leading zero of an abstract address. @param number makes it unique in the process
std::string relayedPeerName(const PeerAddress& peer, std::uint64_t number);

/// Address of a call's client, in the form of grpc::ServerContext::peer(), also for a relayed connection.
std::string peerOf(const grpc::ServerContextBase& call);
/// The same for a name returned by grpc::ServerContext::peer().
std::string peerOfName(std::string_view grpc_peer);

}  // namespace robosim
