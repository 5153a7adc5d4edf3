#include "net/pending_connections.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

#include "net/net_log.h"

namespace robosim {
namespace {

std::atomic<std::size_t>& pendingOfAllGates() {
  static std::atomic<std::size_t> count{0};
  return count;
}

}  // namespace

PendingConnections::PendingConnections(std::string address, std::size_t max)
    : address_(std::move(address)), max_(std::min(kMax, max)), share_(std::max<std::size_t>(1, max_ / 4)) {}

PendingConnections::~PendingConnections() {
  for (auto& [number, pending] : map_) {
    pending.tls.reset();
    close(pending.socket);
  }
  pendingOfAllGates() -= map_.size();
}

PendingConnections::Iterator PendingConnections::add(int listener, int socket) {
  auto peer = PeerAddress::of(socket);
  if (!peer || (pendingOfAllGates() >= max_ && map_.size() >= share_ && !dropOne())) {
    close(socket);
    return end();
  }
  ++pendingOfAllGates();
  std::string network = peer->network();
  return map_
      .emplace(next_++, PendingConnection{.listener = listener,
                                          .socket = socket,
                                          .peer = *std::move(peer),
                                          .network = std::move(network),
                                          .since = PendingConnection::Clock::now()})
      .first;
}

PendingConnection PendingConnections::release(Iterator it) {
  PendingConnection pending = std::move(it->second);
  map_.erase(it);
  --pendingOfAllGates();
  return pending;
}

void PendingConnections::drop(Iterator it) {
  PendingConnection pending = release(it);
  pending.tls.reset();
  const linger at_once{1, 0};
  setsockopt(pending.socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  close(pending.socket);
}

/// Makes room for a connection. @return false if this gate has none to close
bool PendingConnections::dropOne() {
  if (map_.empty()) return false;
  std::map<std::string, std::size_t> count;
  for (const auto& [number, pending] : map_) ++count[pending.network];
  const auto rank = [&](const auto& entry) {
    return std::pair(entry.second.parked_at.has_value(), count[entry.second.network]);
  };
  const auto found =
      std::max_element(map_.begin(), map_.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  logFromNet("connections refused", address_ + ": a connection from " + found->second.peer.host +
                                        " is closed: the limit of " + std::to_string(max_) +
                                        " connections without an authorised call is reached");
  drop(found);
  return true;
}

}  // namespace robosim
