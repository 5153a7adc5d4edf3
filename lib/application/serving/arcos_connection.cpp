#include "serving/arcos_connection.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

namespace robosim {

std::string toHostAndPort(const PeerAddress& peer) {
  const std::string host = peer.is_ipv6 ? "[" + peer.host + "]" : peer.host;
  return host + ":" + std::to_string(peer.port);
}

ArcosConnection::ArcosConnection(const AcceptedConnection& accepted, ArcosSession::Claim claim)
    : socket_(accepted.socket),
      peer_(toHostAndPort(accepted.peer)),
      session_(std::move(claim), ArcosSession::Clock::now()) {
  const int on = 1;
  setsockopt(socket_, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
}

ArcosConnection::~ArcosConnection() { close(socket_); }

bool ArcosConnection::receive(ArcosSession::Clock::time_point now) {
  if (!endReason().empty()) return false;
  std::array<char, 4096> received;
  const ssize_t size = recv(socket_, received.data(), received.size(), 0);
  if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return false;
  if (size <= 0) {
    lost_ = size == 0 ? "it has closed the connection" : std::strerror(errno);
    return false;
  }
  send(session_.receive({received.data(), static_cast<std::size_t>(size)}, now));
  return static_cast<std::size_t>(size) == received.size();
}

void ArcosConnection::poll(ArcosSession::Clock::time_point now) {
  if (!endReason().empty()) return;
  send(session_.receive({}, now));
}

void ArcosConnection::sendCycle() {
  const std::string packets = session_.cycle();
  // A program that falls behind gets newer packets once it has received the older ones.
  if (!endReason().empty() || unsent_.size() > kUnsentMax / 2) return flush();
  send(packets);
}

void ArcosConnection::send(const std::string& bytes) {
  unsent_ += bytes;
  flush();
}

void ArcosConnection::flush() {
  if (unsent_.empty()) return;
  const ssize_t sent = ::send(socket_, unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
  if (sent > 0) unsent_.erase(0, static_cast<std::size_t>(sent));
  const bool would_wait = errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
  if (sent < 0 && !would_wait && lost_.empty()) lost_ = std::strerror(errno);
  if (unsent_.size() > kUnsentMax && lost_.empty()) lost_ = "it does not receive what it has requested";
}

const std::string& ArcosConnection::endReason() const { return lost_.empty() ? session_.endReason() : lost_; }

}  // namespace robosim
