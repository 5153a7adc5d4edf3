#include "net/connection_listener.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "net/host_port.h"
#include "net/net_log.h"

namespace robosim {
namespace {

constexpr int kBacklog = 1024;

/// Raises the soft limit of descriptors (often 1,024) to the hard limit.
/// @return the number of descriptors that connections and everything else may use
int raiseDescriptorLimit() {
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return ConnectionListener::kMaxDescriptors;
  files.rlim_cur = files.rlim_max;
  setrlimit(RLIMIT_NOFILE, &files);
  getrlimit(RLIMIT_NOFILE, &files);
  return static_cast<int>(std::min<rlim_t>(files.rlim_cur, ConnectionListener::kMaxDescriptors));
}

void setOption(int socket, int level, int option) {
  const int on = 1;
  setsockopt(socket, level, option, &on, sizeof on);
}

std::uint16_t readPort(int socket) {
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size);
  return ntohs(own.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6&>(own).sin6_port
                                         : reinterpret_cast<sockaddr_in&>(own).sin_port);
}

/// @return the socket, or -1 with errno
int listenAt(const addrinfo& at, int port) {
  sockaddr_storage address{};
  std::memcpy(&address, at.ai_addr, at.ai_addrlen);
  auto& port_field = at.ai_family == AF_INET6 ? reinterpret_cast<sockaddr_in6&>(address).sin6_port
                                              : reinterpret_cast<sockaddr_in&>(address).sin_port;
  if (port != 0) port_field = htons(static_cast<std::uint16_t>(port));
  const int listener = socket(at.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (listener < 0) return -1;
  setOption(listener, SOL_SOCKET, SO_REUSEADDR);
  if (bind(listener, reinterpret_cast<const sockaddr*>(&address), at.ai_addrlen) == 0 &&
      listen(listener, kBacklog) == 0) {
    return listener;
  }
  const int error = errno;
  close(listener);
  errno = error;
  return -1;
}

std::string describeCause(int error) {
  if (error == EADDRINUSE) return "is another program using the port?";
  if (error == EACCES) return "ports below 1024 are reserved.";
  return std::string(std::strerror(error)) + "; the address must be one of this machine.";
}

struct FreeAddresses {
  void operator()(addrinfo* all) const { freeaddrinfo(all); }
};

std::unique_ptr<addrinfo, FreeAddresses> resolve(const std::string& address, const std::string& option) {
  const HostPort parts = HostPort::of(address);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(parts.host.c_str(), parts.port.c_str(), &hints, &found);
  if (error != 0) {
    throw std::runtime_error("cannot listen on " + address + ": " + gai_strerror(error) +
                             "; name an address of this machine with " + option);
  }
  return std::unique_ptr<addrinfo, FreeAddresses>(found);
}

}  // namespace

ConnectionListener::ConnectionListener(const std::string& address, const std::string& option) : address_(address) {
  const auto all = resolve(address, option);
  int error = 0;
  for (const addrinfo* at = all.get(); at && error != EADDRINUSE; at = at->ai_next) {
    const int listener = listenAt(*at, port_);
    if (listener < 0) {
      error = errno;
      continue;
    }
    listeners_.push_back(listener);
    port_ = readPort(listener);
  }
  if (!listeners_.empty() && error != EADDRINUSE) {
    address_ = withPort(address, port_);
    return;
  }
  for (const int listener : listeners_) close(listener);
  throw std::runtime_error("cannot listen on " + address + ": " + describeCause(error) + " Name another with " +
                           option + ", or :0 for any");
}

ConnectionListener::~ConnectionListener() {
  for (const int listener : listeners_) close(listener);
}

int ConnectionListener::descriptors() {
  static const int the_number = raiseDescriptorLimit();
  return the_number;
}

ConnectionListener::Accepted ConnectionListener::accept(int listener, int& connection) const {
  connection = accept4(listener, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (connection < 0) {
    if (errno == EAGAIN || errno == EWOULDBLOCK) return Accepted::none;
    const bool is_full = errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM;
    if (!is_full) return Accepted::none;  // the client has left
    logFromNet("connections not accepted",
               address_ + ": cannot accept a connection now: " + std::strerror(errno) + "; trying again");
    return Accepted::later;
  }
  if (isReserved(connection)) {
    close(connection);
    logFromNet("connections refused", address_ + ": connection refused: the limit of " + std::to_string(descriptors()) +
                                          " descriptors is reached (ulimit -Hn; at most " +
                                          std::to_string(kMaxDescriptors) + ")");
    return Accepted::none;
  }
  setOption(connection, IPPROTO_TCP, TCP_NODELAY);
  return Accepted::connection;
}

}  // namespace robosim
