#include "tests/scenarios/fault_proxy.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace robosim {
namespace {

constexpr int kPollPeriod_ms = 50;  // polling period for the end

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

sockaddr* plain(sockaddr_in& address) { return reinterpret_cast<sockaddr*>(&address); }

/// Closes with a TCP reset, as after a restart of the machine.
void reset(int socket) {
  const linger abort_on_close{1, 0};
  setsockopt(socket, SOL_SOCKET, SO_LINGER, &abort_on_close, sizeof abort_on_close);
  close(socket);
}

/// @return false at the end of input, or when the receiver is gone
bool pass(int from, int to, FaultProxy::Faults& faults) {
  std::array<char, 4096> bytes;
  auto count = read(from, bytes.data(), bytes.size());
  if (count <= 0) return false;
  const bool is_cut = faults.cut_after >= 0;
  if (is_cut) {
    count = std::min<ssize_t>(count, faults.cut_after);
    faults.cut_after -= static_cast<int>(count);
  }
  if (const int at = faults.flip_after; at >= 0) {
    if (at < count) bytes[static_cast<std::size_t>(at)] = static_cast<char>(bytes[static_cast<std::size_t>(at)] ^ 1);
    faults.flip_after = at < count ? -1 : at - static_cast<int>(count);
  }
  for (ssize_t done = 0; done < count;) {
    const auto sent = send(to, bytes.data() + done, static_cast<std::size_t>(count - done), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    done += sent;
  }
  return !is_cut || faults.cut_after > 0;
}

}  // namespace

FaultProxy::FaultProxy(int port) : port_(port), listener_(socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in own = loopback(0);
  socklen_t size = sizeof own;
  if (bind(listener_, plain(own), size) != 0 || listen(listener_, 1) != 0 ||
      getsockname(listener_, plain(own), &size) != 0) {
    throw std::runtime_error("cannot listen for connections to forward");
  }
  own_port_ = ntohs(own.sin_port);
  thread_ = std::thread([this] { acceptConnections(); });
}

FaultProxy::~FaultProxy() {
  is_ending_ = true;
  thread_.join();
  close(listener_);
}

void FaultProxy::acceptConnections() {
  while (!is_ending_) {
    pollfd call{listener_, POLLIN, 0};
    if (poll(&call, 1, kPollPeriod_ms) > 0) forwardConnection(accept(listener_, nullptr, nullptr));
  }
}

void FaultProxy::forwardConnection(int client) {
  const int server = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in there = loopback(port_);
  bool is_open = connect(server, plain(there), sizeof there) == 0;
  while (is_open && !is_ending_) {
    const short events = is_silent_ ? 0 : POLLIN;
    pollfd ends[] = {{client, events, 0}, {server, events, 0}};
    poll(ends, 2, kPollPeriod_ms);
    if (is_silent_) continue;
    if (ends[0].revents) is_open = pass(client, server, from_client_);
    if (is_open && ends[1].revents) is_open = pass(server, client, to_client_);
  }
  from_client_.cut_after = to_client_.cut_after = -1;
  reset(client);
  reset(server);
}

}  // namespace robosim
