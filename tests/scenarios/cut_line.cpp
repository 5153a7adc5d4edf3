#include "tests/scenarios/cut_line.h"

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

constexpr int kNap_ms = 50;  // how soon the end is noticed

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

sockaddr* plain(sockaddr_in& address) { return reinterpret_cast<sockaddr*>(&address); }

/// Closes so that the other end hears a reset, as when a machine has gone down and come up again.
void closeHard(int socket) {
  const linger at_once{1, 0};
  setsockopt(socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  close(socket);
}

/// @return false when there is nothing more to come, or nobody to take it
bool pass(int from, int to, std::atomic<int>* bytes_left) {
  std::array<char, 4096> bytes;
  auto count = read(from, bytes.data(), bytes.size());
  if (count <= 0) return false;
  const bool is_cut = bytes_left && *bytes_left >= 0;
  if (is_cut) {
    count = std::min<ssize_t>(count, *bytes_left);
    *bytes_left -= static_cast<int>(count);
  }
  for (ssize_t done = 0; done < count;) {
    const auto sent = send(to, bytes.data() + done, static_cast<std::size_t>(count - done), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    done += sent;
  }
  return !is_cut || *bytes_left > 0;
}

}  // namespace

CutLine::CutLine(int port) : port_(port), listener_(socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in own = loopback(0);
  socklen_t size = sizeof own;
  if (bind(listener_, plain(own), size) != 0 || listen(listener_, 1) != 0 ||
      getsockname(listener_, plain(own), &size) != 0) {
    throw std::runtime_error("cannot listen for callers of a line to cut");
  }
  own_port_ = ntohs(own.sin_port);
  thread_ = std::thread([this] { answerCalls(); });
}

CutLine::~CutLine() {
  is_ending_ = true;
  thread_.join();
  close(listener_);
}

void CutLine::answerCalls() {
  while (!is_ending_) {
    pollfd call{listener_, POLLIN, 0};
    if (poll(&call, 1, kNap_ms) > 0) carry(accept(listener_, nullptr, nullptr));
  }
}

void CutLine::carry(int caller) {
  const int called = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in there = loopback(port_);
  bool stands = connect(called, plain(there), sizeof there) == 0;
  while (stands && !is_ending_) {
    const short heard = is_silent_ ? 0 : POLLIN;
    pollfd ends[] = {{caller, heard, 0}, {called, heard, 0}};
    poll(ends, 2, kNap_ms);
    if (is_silent_) continue;
    if (ends[0].revents) stands = pass(caller, called, &bytes_left_);
    if (stands && ends[1].revents) stands = pass(called, caller, nullptr);
  }
  bytes_left_ = -1;
  closeHard(caller);
  closeHard(called);
}

}  // namespace robosim
