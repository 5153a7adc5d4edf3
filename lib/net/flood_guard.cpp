#include "net/flood_guard.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <ctime>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <pthread.h>
#include <sys/socket.h>

#include "net/net_log.h"

namespace robosim::flood_guard {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

struct Peer {
  std::string host;
  std::uint16_t port = 0;
  bool operator==(const Peer&) const = default;

  /// Whether gRPC's name of a peer matches: "ipv4:10.0.0.5:41234", "ipv6:%5Bfe80::1%5D:41234"; in 1.51 an IPv4 address
  /// accepted by an IPv6 socket is "ipv4:".
  bool isNamed(const std::string& peer) const {
    const std::string mapped = "::ffff:";
    const std::string address = host.starts_with(mapped) ? host.substr(mapped.size()) : host;
    const std::string end = ":" + std::to_string(port);
    return peer == "ipv4:" + address + end || peer == "ipv6:[" + address + "]" + end ||
           peer == "ipv6:%5B" + address + "%5D" + end;
  }
};

/// @return nullopt for a descriptor that is not a connected socket
std::optional<Peer> peerOf(int connection) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getpeername(connection, reinterpret_cast<sockaddr*>(&address), &size) != 0) return std::nullopt;
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address.ss_family == AF_INET6) {
    const auto& six = reinterpret_cast<const sockaddr_in6&>(address);
    inet_ntop(AF_INET6, &six.sin6_addr, text.data(), text.size());
    return Peer{text.data(), ntohs(six.sin6_port)};
  }
  const auto& four = reinterpret_cast<const sockaddr_in&>(address);
  inet_ntop(AF_INET, &four.sin_addr, text.data(), text.size());
  return Peer{text.data(), ntohs(four.sin_port)};
}

struct Traffic {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
};

/// @return nullopt for a descriptor that has been closed
std::optional<Traffic> trafficOf(int connection) {
  tcp_info info{};
  socklen_t size = sizeof info;
  if (getsockopt(connection, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return std::nullopt;
  return Traffic{info.tcpi_bytes_received, info.tcpi_bytes_sent};
}

/// Increase of a counter. Another thread may close a connection at any time, and its descriptor may then denote a new
/// connection, whose counters are lower.
std::uint64_t increase(std::uint64_t before, std::uint64_t now) { return now > before ? now - before : 0; }

/// Resets a connection and discards its received data, which shutdown() would leave to be read.
void disconnect(int connection) {
  const sockaddr unspecified{AF_UNSPEC, {}};
  connect(connection, &unspecified, sizeof unspecified);
}

class Guard;
Guard& theGuard();

/// A thread that waits in gRPC.
struct Waiter {
  Waiter();
  ~Waiter();
  Waiter(const Waiter&) = delete;
  Waiter& operator=(const Waiter&) = delete;

  nanoseconds processorTime() const {
    timespec used{};
    clock_gettime(clock, &used);
    return std::chrono::seconds(used.tv_sec) + nanoseconds(used.tv_nsec);
  }

  std::atomic<std::uint64_t> changes{0};  ///< odd during a wait
  clockid_t clock{};
  std::uint64_t seen_changes = 0;  ///< at the guard's last check
  nanoseconds seen_time{0};        ///< its processor time when the guard first saw this wait
};

class Guard {
 public:
  void add(Waiter& waiter) {
    const std::lock_guard lock(mutex_);
    waiters_.push_back(&waiter);
    if (!thread_.joinable()) thread_ = std::thread([this] { watch(); });
  }
  void remove(const Waiter& waiter) {
    const std::lock_guard lock(mutex_);
    std::erase(waiters_, &waiter);
  }
  bool admit(int connection) {
    const std::lock_guard lock(mutex_);
    const auto peer = peerOf(connection);
    if (!peer) return true;  // already disconnected
    const auto now = Clock::now();
    std::erase_if(bans_, [&](const auto& ban) { return ban.second.end <= now; });
    if (const auto ban = bans_.find(peer->host); ban != bans_.end()) {
      if (!hasExempt(peer->host) || now < ban->second.next_admission) return false;
      ban->second.next_admission = now + kThrottle;
    }
    std::erase_if(connections_, [&](const auto& it) { return it.second.peer == *peer; });  // closed: its port is reused
    connections_[connection] = {.peer = *peer};
    return true;
  }
  void exempt(const std::string& peer) {
    const std::lock_guard lock(mutex_);
    if (const auto it = find(peer); it != connections_.end()) ++it->second.exemptions;
  }
  void endExemption(const std::string& peer) {
    const std::lock_guard lock(mutex_);
    const auto it = find(peer);
    if (it == connections_.end() || it->second.exemptions == 0 || --it->second.exemptions > 0) return;
    it->second.exempt_until = Clock::now() + kExemptionLinger;
    it->second.counted = trafficOf(it->first).value_or(it->second.counted);  // all before was exempt
  }

 private:
  struct Connection {
    Peer peer;
    std::uint64_t bytes = 0;           ///< received when the wait was first seen
    Traffic counted{};                 ///< at the last count of bytes
    std::uint64_t unanswered = 0;      ///< bytes
    int exemptions = 0;                ///< number of Exemption objects
    Clock::time_point exempt_until{};  ///< after the last of them

    bool isExempt() const { return exemptions > 0 || Clock::now() < exempt_until; }
  };
  struct Ban {
    Clock::time_point end;
    Clock::time_point next_admission;  ///< from an address that has exempt connections
  };

  using Connections = std::map<int, Connection>;  ///< by descriptor; may include closed ones

  /// @param peer gRPC's name of it
  Connections::iterator find(const std::string& peer) {
    return std::find_if(connections_.begin(), connections_.end(),
                        [&](const auto& it) { return it.second.peer.isNamed(peer); });
  }
  bool hasExempt(const std::string& host) const {
    return std::any_of(connections_.begin(), connections_.end(),
                       [&](const auto& it) { return it.second.peer.host == host && it.second.isExempt(); });
  }

  [[noreturn]] void watch() {
    for (int period = 1;; ++period) {
      std::this_thread::sleep_for(kPeriod);
      const std::lock_guard lock(mutex_);
      for (Waiter* waiter : waiters_) inspect(*waiter);
      if (period % kPeriodsPerCount == 0) countBytes();
    }
  }

  void inspect(Waiter& waiter) {
    const auto changes = waiter.changes.load(std::memory_order_relaxed);
    const bool waits = changes % 2 == 1;
    const bool is_new = std::exchange(waiter.seen_changes, changes) != changes;
    if (!waits) return;
    const auto now = waiter.processorTime();
    if (is_new) {
      waiter.seen_time = now;
      has_bytes_ = false;
      return;
    }
    // Querying every connection is expensive, so it is only done for a long wait.
    if (now - waiter.seen_time > kBusyLimit / 4 && !has_bytes_) recordBytes();
    if (now - waiter.seen_time < kBusyLimit) return;
    waiter.seen_time = now;
    // Without a culprit, the bytes of this wait are counted further: a slow machine handles few frames in kBusyLimit.
    if (disconnectBusiest()) has_bytes_ = false;
  }

  void removeClosed() {
    std::erase_if(connections_, [](const auto& it) { return peerOf(it.first) != it.second.peer; });
  }

  void recordBytes() {
    has_bytes_ = true;
    removeClosed();
    for (auto& [descriptor, connection] : connections_)
      connection.bytes = trafficOf(descriptor).value_or(Traffic{}).received;
  }

  void countBytes() {
    removeClosed();
    for (auto it = connections_.begin(); it != connections_.end();) {
      const auto here = it++;  // ban() removes it
      Connection& connection = here->second;
      const auto now = trafficOf(here->first);
      if (!now) continue;
      connection.unanswered += increase(connection.counted.received, now->received);
      connection.unanswered -= std::min(connection.unanswered, increase(connection.counted.sent, now->sent));
      connection.counted = *now;
      if (connection.isExempt()) connection.unanswered = 0;
      if (connection.unanswered > kMaxUnansweredBytes) ban(here);
    }
  }

  /// @return whether a connection has sent enough to be the cause
  bool disconnectBusiest() {
    auto busiest = connections_.end();
    std::uint64_t max_sent = 0;
    for (auto it = connections_.begin(); it != connections_.end(); ++it) {
      const auto now = trafficOf(it->first);
      const std::uint64_t sent = now ? increase(it->second.bytes, now->received) : 0;
      if (sent <= max_sent || sent < (it->second.isExempt() ? kMaxExemptBytes : kMinBytes)) continue;
      busiest = it;
      max_sent = sent;
    }
    if (busiest == connections_.end()) return false;
    ban(busiest);
    return true;
  }

  /// Disconnects, and bans or throttles the address; only removes a connection that has been closed.
  void ban(Connections::iterator it) {
    const auto [descriptor, connection] = *it;
    const Peer& peer = connection.peer;
    connections_.erase(it);
    if (peerOf(descriptor) != peer) return;
    disconnect(descriptor);
    const auto now = Clock::now();
    bans_[peer.host] = {now + kBan, now + kThrottle};
    const std::string consequence = hasExempt(peer.host)
                                        ? "at most one connection from " + peer.host + " is accepted each " +
                                              std::to_string(kThrottle.count()) + " s for "
                                        : "no connection from " + peer.host + " is accepted for ";
    logFromNet("floods", peer.host + " port " + std::to_string(peer.port) +
                             ": disconnected: it floods the server with HTTP/2 frames; " + consequence +
                             std::to_string(kBan.count()) + " s");
  }

  std::mutex mutex_;
  std::vector<Waiter*> waiters_;
  Connections connections_;
  std::map<std::string, Ban> bans_;  ///< by host
  bool has_bytes_ = false;           ///< of the wait under examination
  std::thread thread_;
};

/// Never destroyed: its thread runs until the process ends.
Guard& theGuard() {
  static auto* const guard = new Guard;
  return *guard;
}

Waiter::Waiter() {
  pthread_getcpuclockid(pthread_self(), &clock);
  theGuard().add(*this);
}
Waiter::~Waiter() { theGuard().remove(*this); }

Waiter& waiterOfThisThread() {
  static thread_local Waiter waiter;
  return waiter;
}

}  // namespace

bool admit(int connection) { return theGuard().admit(connection); }

Exemption::Exemption(std::string peer) : peer_(std::move(peer)) {
  if (!peer_.empty()) theGuard().exempt(peer_);
}
Exemption::~Exemption() {
  if (!peer_.empty()) theGuard().endExemption(peer_);
}

Wait::Wait() { waiterOfThisThread().changes.fetch_add(1, std::memory_order_relaxed); }
Wait::~Wait() { waiterOfThisThread().changes.fetch_add(1, std::memory_order_relaxed); }

}  // namespace robosim::flood_guard
