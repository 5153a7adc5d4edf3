#include "dds/cyclone/local_sockets.h"

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include <linux/filter.h>
#include <linux/if_arp.h>
#include <linux/if_packet.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace robosim::dds {
namespace {

/// UDP port of a socket; -1 for other files.
int udpPort(int file) {
  int type = 0;
  socklen_t size = sizeof type;
  if (getsockopt(file, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return -1;
  sockaddr_in address{};
  size = sizeof address;
  if (getsockname(file, reinterpret_cast<sockaddr*>(&address), &size) != 0 || address.sin_family != AF_INET) return -1;
  return ntohs(address.sin_port);
}

void ignoreOtherMachinesOn(int socket) {
  sock_filter steps[] = {
      {BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<__u32>(SKF_AD_OFF + SKF_AD_HATYPE)},
      {BPF_JMP | BPF_JEQ | BPF_K, 2, 0, ARPHRD_LOOPBACK},
      {BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<__u32>(SKF_AD_OFF + SKF_AD_PKTTYPE)},
      {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, PACKET_LOOPBACK},
      {BPF_RET | BPF_K, 0, 0, ~0u},  // the whole packet
      {BPF_RET | BPF_K, 0, 0, 0},
  };
  const sock_fprog filter{sizeof steps / sizeof *steps, steps};
  if (setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) != 0) {
    throw std::runtime_error("ROS 2 cannot be restricted to this machine: " + std::system_category().message(errno));
  }
}

}  // namespace

void ignoreOtherMachines(int domain) {
  // Ports of a domain. Source: OMG DDSI-RTPS 2.3, 9.6.1.1
  const int first_port = 7400 + 250 * domain;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const std::string name = entry.path().filename().string();
    int file = -1;
    std::from_chars(name.data(), name.data() + name.size(), file);
    const int port = udpPort(file);
    if (port >= first_port && port < first_port + 250) ignoreOtherMachinesOn(file);
  }
}

}  // namespace robosim::dds
