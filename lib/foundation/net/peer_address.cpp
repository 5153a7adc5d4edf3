#include "net/peer_address.h"

#include <algorithm>
#include <array>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace robosim {
namespace {

/// Names of relayed connections begin with it. Programs of other users may bind abstract addresses as well, but only
/// this process passes its sockets to gRPC.
constexpr std::string_view kRelayed = "robosim-relayed/";

/// gRPC's name of a link-local peer has its interface, "ipv6:%5Bfe80::1%25eth0%5D:3000", which PeerAddress has not.
std::string withoutZone(std::string_view grpc_peer) {
  constexpr std::string_view kBegin = "ipv6:%5B", kEnd = "%5D";
  std::string name(grpc_peer);
  const auto end = name.find(kEnd);
  if (!name.starts_with(kBegin) || end == std::string::npos) return name;
  const auto zone = name.find('%', kBegin.size());
  return zone < end ? name.erase(zone, end - zone) : name;
}

}  // namespace

std::optional<PeerAddress> PeerAddress::of(int connection) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getpeername(connection, reinterpret_cast<sockaddr*>(&address), &size) != 0) return std::nullopt;
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address.ss_family == AF_INET6) {
    const auto& six = reinterpret_cast<const sockaddr_in6&>(address);
    if (!IN6_IS_ADDR_V4MAPPED(&six.sin6_addr)) {
      inet_ntop(AF_INET6, &six.sin6_addr, text.data(), text.size());
      return PeerAddress{text.data(), ntohs(six.sin6_port), true};
    }
    inet_ntop(AF_INET, &six.sin6_addr.s6_addr[12], text.data(), text.size());
    return PeerAddress{text.data(), ntohs(six.sin6_port), false};
  }
  if (address.ss_family != AF_INET) return std::nullopt;
  const auto& four = reinterpret_cast<const sockaddr_in&>(address);
  inet_ntop(AF_INET, &four.sin_addr, text.data(), text.size());
  return PeerAddress{text.data(), ntohs(four.sin_port), false};
}

std::string PeerAddress::grpcName() const {
  return is_ipv6 ? "ipv6:%5B" + host + "%5D:" + std::to_string(port) : "ipv4:" + host + ":" + std::to_string(port);
}

std::string PeerAddress::network() const {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (in6_addr six{}; is_ipv6 && inet_pton(AF_INET6, host.c_str(), &six) == 1) {
    std::fill(six.s6_addr + 8, six.s6_addr + 16, 0);
    inet_ntop(AF_INET6, &six, text.data(), text.size());
    return text.data() + std::string("/64");
  }
  if (in_addr four{}; inet_pton(AF_INET, host.c_str(), &four) == 1 && ntohl(four.s_addr) >> 24 == 127) {
    four.s_addr &= htonl(0xFFFFFF00);
    inet_ntop(AF_INET, &four, text.data(), text.size());
    return text.data() + std::string("/24");
  }
  return host;
}

std::string relayedPeerName(const PeerAddress& peer, std::uint64_t number) {
  return std::string(kRelayed) + std::to_string(getpid()) + "/" + std::to_string(number) + "/" +
         (peer.is_ipv6 ? "6/" : "4/") + peer.host + "/" + std::to_string(peer.port);
}

std::string peerOfName(std::string_view grpc_peer) {
  std::string name(grpc_peer);
  for (std::size_t at = 0; (at = name.find("%2F", at)) != std::string::npos;) name.replace(at, 3, "/");
  const auto begin = name.find(kRelayed);
  if (!name.starts_with("unix") || begin == std::string::npos) return withoutZone(grpc_peer);
  const auto port = name.rfind('/');
  const auto host = name.rfind('/', port - 1);
  const bool is_ipv6 = name[host - 1] == '6';
  const PeerAddress peer{name.substr(host + 1, port - host - 1),
                         static_cast<std::uint16_t>(std::stoi(name.substr(port + 1))), is_ipv6};
  return peer.grpcName();
}

std::string peerOf(const grpc::ServerContextBase& call) { return peerOfName(call.peer()); }

}  // namespace robosim
