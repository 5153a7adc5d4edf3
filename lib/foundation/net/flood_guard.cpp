#include "net/flood_guard.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <ctime>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <pthread.h>
#include <sys/socket.h>
#include <unistd.h>

#include "net/net_log.h"

namespace robosim::flood_guard {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

struct Traffic {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
};

/// @return nullopt for a descriptor that has been closed
std::optional<Traffic> readTraffic(int connection) {
  tcp_info info{};
  socklen_t size = sizeof info;
  if (getsockopt(connection, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return std::nullopt;
  return Traffic{info.tcpi_bytes_received, info.tcpi_bytes_sent};
}

/// Increase of a counter. Another thread may close a connection at any time, and its descriptor may then denote a new
/// connection, whose counters are lower.
std::uint64_t increase(std::uint64_t before, std::uint64_t now) { return now > before ? now - before : 0; }

/// Resets the connection of a peer and discards its received data, which shutdown() would leave to be read. Acts on a
/// duplicate: another thread may close the descriptor meanwhile, which may then denote another connection.
/// @return false when the descriptor no longer denotes that connection
bool disconnect(int descriptor, const PeerAddress& peer) {
  const int connection = fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
  if (connection < 0) return false;
  const bool is_same = PeerAddress::of(connection) == peer;
  const sockaddr unspecified{AF_UNSPEC, {}};
  if (is_same) connect(connection, &unspecified, sizeof unspecified);
  close(connection);
  return is_same;
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
  void admit(int connection, bool is_authorised) {
    const std::lock_guard lock(mutex_);
    const auto peer = PeerAddress::of(connection);
    if (!peer) return;                                                                     // already disconnected
    std::erase_if(connections_, [&](const auto& it) { return it.second.peer == *peer; });  // closed: its port is reused
    connections_[connection] = {.peer = *peer, .is_authorised = is_authorised};
  }
  std::size_t unauthorised() {
    const std::lock_guard lock(mutex_);
    removeClosed([](const Connection& connection) { return !connection.is_authorised; });
    return static_cast<std::size_t>(std::count_if(connections_.begin(), connections_.end(),
                                                  [](const auto& it) { return !it.second.is_authorised; }));
  }
  void noteAuthorised(const std::string& peer) {
    const std::lock_guard lock(mutex_);
    if (const auto it = find(peer); it != connections_.end()) it->second.is_authorised = true;
  }
  void noteRefused(const std::string& peer) {
    const std::lock_guard lock(mutex_);
    const auto it = find(peer);
    if (it == connections_.end() || it->second.is_authorised) return;
    if (++it->second.refused_calls > kMaxRefusedCalls) disconnectFlood(it, "repeats calls that are refused");
  }
  void reportFlood(const PeerAddress& peer, std::string_view what) {
    const std::lock_guard lock(mutex_);
    ban(peer, what);
  }
  void raiseAlarm(const std::string& why) {
    const std::lock_guard lock(mutex_);
    raise(why);
  }
  bool isAlarmed() {
    const std::lock_guard lock(mutex_);
    return Clock::now() < alarm_end_;
  }
  bool isBanned(const std::string& network) {
    const std::lock_guard lock(mutex_);
    const auto found = bans_.find(network);
    return found != bans_.end() && Clock::now() < found->second;
  }
  void endAlarm() {
    const std::lock_guard lock(mutex_);
    bans_.clear();
    alarm_end_ = {};
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
    it->second.counted = readTraffic(it->first).value_or(it->second.counted);  // all before was exempt
  }

 private:
  struct Connection {
    PeerAddress peer;
    bool is_authorised = false;  ///< has made an authorised call
    int refused_calls = 0;
    std::uint64_t bytes = 0;           ///< received when the wait was first seen
    Traffic counted{};                 ///< at the last count of bytes
    std::uint64_t unanswered = 0;      ///< bytes
    int exemptions = 0;                ///< number of Exemption objects
    Clock::time_point exempt_until{};  ///< after the last of them

    bool isExempt() const { return exemptions > 0 || Clock::now() < exempt_until; }
  };
  using Connections = std::map<int, Connection>;  ///< by descriptor; may include closed ones

  static constexpr std::size_t kMaxBans = 4096;

  static bool isOpen(int descriptor, const PeerAddress& peer) { return PeerAddress::of(descriptor) == peer; }

  /// @param peer as returned by peerOf()
  Connections::iterator find(const std::string& peer) {
    const std::string end = peer.substr(std::min(peer.rfind(':'), peer.size()));
    const auto port = static_cast<std::uint16_t>(end.size() > 1 ? std::strtoul(end.c_str() + 1, nullptr, 10) : 0);
    return std::find_if(connections_.begin(), connections_.end(), [&](const auto& it) {
      return it.second.peer.port == port && it.second.peer.grpcName() == peer;
    });
  }

  [[noreturn]] void watch() {
    for (int period = 1;; ++period) {
      std::this_thread::sleep_for(kPeriod);
      const std::lock_guard lock(mutex_);
      for (Waiter* waiter : waiters_) inspect(*waiter);
      disconnectUnauthorised();
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

  /// Removes the closed ones of some connections.
  template <typename Filter>
  void removeClosed(const Filter& isMeant) {
    int failed = 0;
    std::erase_if(connections_, [&](const auto& it) {
      if (!isMeant(it.second) || isOpen(it.first, it.second.peer)) return false;
      failed += it.second.is_authorised ? 0 : 1;
      return true;
    });
    if (failed > 0) noteFailures(failed);
  }
  void removeClosed() {
    removeClosed([](const Connection&) { return true; });
  }

  /// Connections have been closed without an authorised call.
  void noteFailures(int count) {
    const auto now = Clock::now();
    if (now - failures_since_ >= std::chrono::seconds(1)) failures_ = 0;
    if (failures_ == 0) failures_since_ = now;
    failures_ += count;
    if (failures_ <= kMaxFailures) return;
    failures_ = 0;
    raise("more than " + std::to_string(kMaxFailures) + " connections in a second had no authorised call");
  }
  void raise(const std::string& why) {
    if (Clock::now() >= alarm_end_) {
      logFromNet("floods", why + "; for " + std::to_string(kAlarm.count()) +
                               " s new connections are served after an authorised call only");
    }
    startAlarm();
  }

  void recordBytes() {
    has_bytes_ = true;
    removeClosed();
    for (auto& [descriptor, connection] : connections_)
      connection.bytes = readTraffic(descriptor).value_or(Traffic{}).received;
  }

  /// A client whose bytes are answered with as many, such as PING, may flood in waits that end soon.
  void disconnectUnauthorised() {
    for (auto it = connections_.begin(); it != connections_.end();) {
      const auto here = it++;
      if (here->second.is_authorised || here->second.isExempt()) continue;
      const auto now = readTraffic(here->first);
      if (!now || now->received <= kMinBytes || !isOpen(here->first, here->second.peer)) continue;
      disconnectFlood(here, kFrames);
      return;  // the alarm disconnects the others
    }
  }

  void countBytes() {
    removeClosed();
    for (auto it = connections_.begin(); it != connections_.end();) {
      const auto here = it++;
      Connection& connection = here->second;
      const auto now = readTraffic(here->first);
      if (!now) continue;
      connection.unanswered += increase(connection.counted.received, now->received);
      connection.unanswered -= std::min(connection.unanswered, increase(connection.counted.sent, now->sent));
      connection.counted = *now;
      if (connection.isExempt()) connection.unanswered = 0;
      if (connection.unanswered <= kMaxUnansweredBytes) continue;
      disconnectFlood(here, kFrames);
      return;  // the alarm may have removed the others; those that remain are counted next time
    }
  }

  /// @return whether a connection has sent enough to be the cause
  bool disconnectBusiest() {
    auto busiest = connections_.end();
    std::uint64_t max_sent = 0;
    for (auto it = connections_.begin(); it != connections_.end(); ++it) {
      const auto now = readTraffic(it->first);
      const std::uint64_t sent = now ? increase(it->second.bytes, now->received) : 0;
      if (sent <= max_sent || sent < (it->second.isExempt() ? kMaxExemptBytes : kMinBytes)) continue;
      busiest = it;
      max_sent = sent;
    }
    if (busiest == connections_.end()) return false;
    disconnectFlood(busiest, kFrames);
    return true;
  }

  static constexpr std::string_view kFrames = "floods the server with HTTP/2 frames";

  /// Disconnects, and bans the network; only removes a connection that has been closed.
  void disconnectFlood(Connections::iterator it, std::string_view what) {
    const auto [descriptor, connection] = *it;
    connections_.erase(it);
    if (disconnect(descriptor, connection.peer)) ban(connection.peer, what);
  }

  void ban(const PeerAddress& peer, std::string_view what) {
    const std::string network = peer.network();
    const auto now = Clock::now();
    std::erase_if(bans_, [&](const auto& ban) { return ban.second <= now; });
    if (bans_.size() >= kMaxBans) bans_.erase(bans_.begin());
    bans_[network] = now + kAlarm;
    logFromNet("floods", peer.host + " port " + std::to_string(peer.port) + ": disconnected: it " + std::string(what) +
                             "; for " + std::to_string(kAlarm.count()) +
                             " s new connections are served after an authorised call only, those from " + network +
                             " last");
    startAlarm();
  }

  /// Connections without an authorised call may take part in the flood.
  void startAlarm() {
    const auto now = Clock::now();
    const bool is_new = now >= std::exchange(alarm_end_, now + kAlarm);
    if (!is_new) return;
    std::erase_if(connections_, [](const auto& it) {
      if (!it.second.is_authorised) disconnect(it.first, it.second.peer);
      return !it.second.is_authorised;
    });
  }

  std::mutex mutex_;
  std::vector<Waiter*> waiters_;
  Connections connections_;
  std::map<std::string, Clock::time_point> bans_;  ///< end, by network
  Clock::time_point alarm_end_{};
  int failures_ = 0;
  Clock::time_point failures_since_{};
  bool has_bytes_ = false;  ///< of the wait under examination
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

void admit(int connection, bool is_authorised) { theGuard().admit(connection, is_authorised); }
std::size_t unauthorised() { return theGuard().unauthorised(); }
void noteAuthorised(const std::string& peer) { theGuard().noteAuthorised(peer); }
void noteRefused(const std::string& peer) { theGuard().noteRefused(peer); }
void reportFlood(const PeerAddress& peer, std::string_view what) { theGuard().reportFlood(peer, what); }
void raiseAlarm(const std::string& why) { theGuard().raiseAlarm(why); }
bool isAlarmed() { return theGuard().isAlarmed(); }
bool isBanned(const std::string& network) { return theGuard().isBanned(network); }
void endAlarm() { theGuard().endAlarm(); }

Exemption::Exemption(std::string peer) : peer_(std::move(peer)) {
  if (!peer_.empty()) theGuard().exempt(peer_);
}
Exemption::~Exemption() {
  if (!peer_.empty()) theGuard().endExemption(peer_);
}

Wait::Wait() { waiterOfThisThread().changes.fetch_add(1, std::memory_order_relaxed); }
Wait::~Wait() { waiterOfThisThread().changes.fetch_add(1, std::memory_order_relaxed); }

}  // namespace robosim::flood_guard
