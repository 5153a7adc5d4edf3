#include "net/pending_connections.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "net/net_log.h"

namespace robosim {
namespace {

std::atomic<std::size_t>& pendingOfProcess() {
  static std::atomic<std::size_t> count{0};
  return count;
}

}  // namespace

PendingConnections::PendingConnections(Limit limit, std::function<void(Number)> close)
    : limit_(std::move(limit)), share_(std::max<std::size_t>(1, limit_.max / 4)), close_(std::move(close)) {}

PendingConnections::~PendingConnections() { pendingOfProcess() -= connections_.size(); }

std::optional<PendingConnections::Number> PendingConnections::add(const PeerAddress& peer) {
  if (pendingOfProcess() >= limit_.max && connections_.size() >= share_) {
    const auto closed = closeOne();
    if (!closed) return std::nullopt;
    logFromNet("connections refused", limit_.address + ": a connection from " + closed->host +
                                          " is closed: the limit of " + std::to_string(limit_.max) + " " + limit_.kind +
                                          " is reached");
  }
  ++pendingOfProcess();
  networks_[peer.network()].others.insert(next_);
  connections_[next_] = {.peer = peer};
  return next_++;
}

void PendingConnections::remove(Number number) {
  const auto found = connections_.find(number);
  if (found == connections_.end()) return;
  const auto network = networks_.find(found->second.peer.network());
  if (found->second.is_flood) --floods_;
  network->second.floods.erase(number);
  network->second.others.erase(number);
  if (network->second.size() == 0) networks_.erase(network);
  connections_.erase(found);
  --pendingOfProcess();
}

void PendingConnections::noteFlood(Number number) {
  const auto found = connections_.find(number);
  if (found == connections_.end() || std::exchange(found->second.is_flood, true)) return;
  ++floods_;
  Network& network = networks_[found->second.peer.network()];
  network.others.erase(number);
  network.floods.insert(number);
}

/// The connection to close first. There must be one.
PendingConnections::Number PendingConnections::worst() const {
  std::size_t most = 0;
  Number oldest = 0;
  for (const auto& [name, network] : networks_) {
    const auto& candidates = floods_ > 0 ? network.floods : network.others;
    if (candidates.empty() || network.size() < most) continue;
    if (network.size() == most && *candidates.begin() > oldest) continue;
    most = network.size();
    oldest = *candidates.begin();
  }
  return oldest;
}

std::optional<PeerAddress> PendingConnections::closeOne() {
  if (connections_.empty()) return std::nullopt;
  const Number number = worst();
  PeerAddress peer = connections_.at(number).peer;
  remove(number);
  close_(number);
  return peer;
}

}  // namespace robosim
