#include "net/connection_gate.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include <poll.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "net/connection_opening.h"
#include "net/flood_guard.h"
#include "net/net_log.h"
#include "net/tls_relay.h"

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

/// Processor time that the gates of the process may use: a token bucket.
class ProcessorBudget {
 public:
  void spend(nanoseconds used) {
    const std::lock_guard lock(mutex_);
    refill();
    available_ -= used;
  }
  /// Time until there is some again; 0 if there is.
  std::chrono::milliseconds wait() {
    const std::lock_guard lock(mutex_);
    refill();
    if (available_ > nanoseconds(0)) return std::chrono::milliseconds(0);
    return std::chrono::ceil<std::chrono::milliseconds>(
        std::chrono::duration<double, std::nano>(static_cast<double>(-available_.count()) /
                                                 ConnectionGate::kProcessorShare) +
        std::chrono::milliseconds(1));
  }

 private:
  void refill() {
    const auto now = Clock::now();
    const auto earned =
        std::chrono::duration<double, std::nano>(now - std::exchange(refilled_, now)) * ConnectionGate::kProcessorShare;
    available_ =
        std::min<nanoseconds>(ConnectionGate::kBurst, available_ + std::chrono::duration_cast<nanoseconds>(earned));
  }
  std::mutex mutex_;
  Clock::time_point refilled_ = Clock::now();
  nanoseconds available_ = ConnectionGate::kBurst;
};

ProcessorBudget& budget() {
  static auto* const the_budget = new ProcessorBudget;
  return *the_budget;
}

std::atomic<std::size_t>& pendingOfAllGates() {
  static std::atomic<std::size_t> count{0};
  return count;
}

nanoseconds processorTimeOfThread() {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return std::chrono::seconds(used.tv_sec) + nanoseconds(used.tv_nsec);
}

/// SETTINGS with SETTINGS_MAX_CONCURRENT_STREAMS (3).
constexpr std::array<char, 15> kSettings{0, 0, 6, 4, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, ConnectionOpening::kMaxCalls};

/// Closes a connection with a reset, so that the client's unread bytes do not delay it.
void closeWithReset(int connection) {
  const linger at_once{1, 0};
  setsockopt(connection, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  close(connection);
}

/// A connection before its first authorised call.
struct Pending {
  enum class State {
    reading,
    waiting,  ///< raw, with TLS: for a place within gRPC
    parked,   ///< a flood that is not read any further
  };
  int listener = -1, connection = -1;
  PeerAddress peer;
  std::string network;
  Clock::time_point since, parked_at{};
  State state = State::reading;
  ConnectionOpening opening{};
  std::unique_ptr<TlsServer::Connection> tls{};
  bool has_settings = false;
  bool wants_place = false;  ///< has made calls that are not authorised
  std::uint32_t last_checked_stream = 0;
};

}  // namespace

/// The thread of a gate.
class ConnectionGate::Loop {
 public:
  Loop(const ConnectionListener& listener, const Options& options, std::function<void(Admitted)> take, int end)
      : listener_(listener),
        options_(options),
        take_(std::move(take)),
        end_(end),
        tls_(options.tls ? std::make_shared<TlsServer>(*options.tls) : nullptr),
        events_(epoll_create1(EPOLL_CLOEXEC)),
        max_pending_(std::min<std::size_t>(
            kMaxPending, static_cast<std::size_t>(
                             std::max(2, listener.descriptors() - ConnectionListener::kReservedDescriptors) / 2))) {
    if (events_ < 0) throw std::runtime_error("cannot listen on " + listener.address() + ": " + std::strerror(errno));
    watch(end_, kEnd);
    for (const int socket : listener_.sockets()) watch(socket, kListener);
  }
  ~Loop() {
    for (auto& [number, pending] : pending_) close(pending.connection);
    pendingOfAllGates() -= pending_.size();
    close(events_);
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void run() {
    used_ = processorTimeOfThread();
    std::vector<epoll_event> ready(1024);
    for (;;) {
      if (const auto wait = budget().wait(); wait.count() > 0 && isEndedWithin(wait)) return;
      const int count = epoll_wait(events_, ready.data(), static_cast<int>(ready.size()), timeoutMs());
      if (count < 0 && errno != EINTR) return;
      for (int i = 0; i < count; ++i) {
        if (ready[static_cast<std::size_t>(i)].data.u64 == kEnd) return;
      }
      acceptAll();
      handle({ready.begin(), ready.begin() + std::max(0, count)});
      passTime();
      account();
    }
  }

 private:
  using Number = std::uint64_t;  ///< of a pending connection, in the order of acceptance
  using PendingMap = std::map<Number, Pending>;
  static constexpr Number kEnd = 0, kListener = 1, kFirst = 2;
  static constexpr int kAcceptsAtOnce = 64;
  static constexpr std::chrono::milliseconds kTick{10};
  static constexpr std::chrono::seconds kStalled{1};

  void watch(int descriptor, Number number) const {
    epoll_event event{};
    event.events = EPOLLIN | EPOLLRDHUP;
    event.data.u64 = number;
    epoll_ctl(events_, EPOLL_CTL_ADD, descriptor, &event);
  }
  bool isEndedWithin(std::chrono::milliseconds wait) const {
    pollfd end{end_, POLLIN, 0};
    return poll(&end, 1, static_cast<int>(wait.count())) > 0;
  }
  int timeoutMs() const {
    if (accepts_later_ || any_waits_) return static_cast<int>(kTick.count());
    constexpr int kDeadlineCheckMs = 50;
    return pending_.empty() ? -1 : kDeadlineCheckMs;
  }
  /// Charges the processor time since the last call to the budget.
  void account() {
    const auto now = processorTimeOfThread();
    budget().spend(now - std::exchange(used_, now));
  }

  void acceptAll() {
    accepts_later_ = false;
    for (const int socket : listener_.sockets()) {
      for (int i = 0; i < kAcceptsAtOnce; ++i) {
        int connection = -1;
        const auto accepted = listener_.accept(socket, connection);
        accepts_later_ = accepts_later_ || accepted == ConnectionListener::Accepted::later;
        if (accepted != ConnectionListener::Accepted::connection) break;
        add(socket, connection);
      }
    }
  }

  void add(int listener, int connection) {
    const auto peer = PeerAddress::of(connection);
    if (!peer) {
      close(connection);
      return;
    }
    if (pendingOfAllGates() >= max_pending_ && !evict()) {
      close(connection);
      return;
    }
    const Number number = next_++;
    ++pendingOfAllGates();
    Pending& pending = pending_[number];
    pending.listener = listener;
    pending.connection = connection;
    pending.peer = *peer;
    pending.network = peer->network();
    pending.since = Clock::now();
    if (!tls_) {
      watch(connection, number);
      return;
    }
    pending.state = Pending::State::waiting;
    any_waits_ = true;
    passToFreePlaces();
  }

  /// Makes room for a connection. @return false if there is none to close
  bool evict() {
    if (pending_.empty()) return false;
    std::map<std::string, std::size_t> count;
    for (const auto& [number, pending] : pending_) ++count[pending.network];
    const auto rank = [&](const auto& entry) {
      return std::pair(entry.second.state == Pending::State::parked, count[entry.second.network]);
    };
    const auto found = std::max_element(pending_.begin(), pending_.end(),
                                        [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    logFromNet("connections refused", listener_.address() + ": a connection from " + found->second.peer.host +
                                          " is closed: the limit of " + std::to_string(max_pending_) +
                                          " connections without an authorised call is reached");
    drop(found);
    return true;
  }

  void drop(PendingMap::iterator it) {
    it->second.tls.reset();
    closeWithReset(it->second.connection);
    remove(it);
  }
  void remove(PendingMap::iterator it) {
    pending_.erase(it);
    --pendingOfAllGates();
  }

  /// Reads the connections that have sent something: those of banned networks last.
  void handle(std::vector<epoll_event> ready) {
    std::erase_if(ready, [](const epoll_event& event) { return event.data.u64 < kFirst; });
    if (ready.empty()) return;
    if (flood_guard::isAlarmed()) {
      std::stable_partition(ready.begin(), ready.end(), [&](const epoll_event& event) {
        const auto found = pending_.find(event.data.u64);
        return found != pending_.end() && !flood_guard::isBanned(found->second.network);
      });
    }
    for (const auto& event : ready) {
      const auto found = pending_.find(event.data.u64);
      if (found == pending_.end()) continue;
      read(found);
      account();
      if (budget().wait().count() > 0) return;  // the others are reported again
    }
  }

  void read(PendingMap::iterator it) {
    Pending& pending = it->second;
    const ssize_t size =
        pending.tls ? pending.tls->read(buffer_) : recv(pending.connection, buffer_.data(), buffer_.size(), 0);
    const bool would_wait = pending.tls ? size == 0 : size < 0 && (errno == EAGAIN || errno == EINTR);
    if (would_wait) return;
    if (size <= 0) {
      drop(it);
      return;
    }
    switch (pending.opening.add({buffer_.data(), static_cast<std::size_t>(size)})) {
      case ConnectionOpening::Verdict::valid:
        break;
      case ConnectionOpening::Verdict::no_http2:
        logFromNet("connections without HTTP/2",
                   listener_.address() + ": " + pending.peer.host +
                       ": connection closed: it does not begin with HTTP/2" +
                       (tls_ ? "" : "; does the client expect TLS, and is the server started without --tls-cert?"));
        drop(it);
        return;
      case ConnectionOpening::Verdict::invalid:
      case ConnectionOpening::Verdict::excess:
        flood_guard::reportFlood(pending.peer, "floods the server with HTTP/2 frames");
        park(it);
        return;
    }
    if (pending.opening.hasPreface() && !std::exchange(pending.has_settings, true)) {
      send(pending, {kSettings.data(), kSettings.size()});
    }
    if (isAuthorised(pending)) {
      passDecrypted(it, true);
      return;
    }
    pending.wants_place = !pending.opening.calls().empty();
    if (pending.wants_place) passToPlace(it);
  }

  static void send(Pending& pending, std::string_view bytes) {
    if (pending.tls) {
      pending.tls->write(bytes);
    } else if (::send(pending.connection, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) {
      return;  // the next read reports it
    }
  }

  bool isAuthorised(Pending& pending) const {
    for (const auto& call : pending.opening.calls()) {
      if (std::any_of(options_.public_paths.begin(), options_.public_paths.end(),
                      [&](const std::string& path) { return call.path.starts_with(path); }))
        return true;
      if (options_.access.isOpen()) {
        if (call.hasMessage()) return true;
        continue;
      }
      if (call.stream <= pending.last_checked_stream) continue;
      pending.last_checked_stream = call.stream;
      if (options_.access.authenticateHeader(call.token, pending.peer.grpcName()).status.ok()) return true;
    }
    return false;
  }

  /// A connection whose calls are not authorised: passes it on so that a session answers, unless there is an alarm.
  /// @return false if it must wait
  bool passToPlace(PendingMap::iterator it) {
    if (flood_guard::isAlarmed()) {
      if (options_.access.isOpen()) return false;  // its message may follow
      park(it);
      return true;
    }
    if (flood_guard::unauthorised() >= flood_guard::kMaxUnauthorised) {
      any_waits_ = true;
      return false;
    }
    passDecrypted(it, false);
    return true;
  }

  void park(PendingMap::iterator it) {
    Pending& pending = it->second;
    epoll_ctl(events_, EPOLL_CTL_DEL, pending.connection, nullptr);
    pending.state = Pending::State::parked;
    pending.parked_at = Clock::now();
    pending.opening = {};
    pending.tls.reset();
  }

  void passDecrypted(PendingMap::iterator it, bool is_authorised) {
    account();
    Pending pending = std::move(it->second);
    epoll_ctl(events_, EPOLL_CTL_DEL, pending.connection, nullptr);
    remove(it);
    flood_guard::admit(pending.connection, is_authorised);
    int connection = pending.connection;
    if (pending.tls) connection = TlsRelay::start(pending.connection, tls_, std::move(pending.tls));
    last_passed_ = Clock::now();
    if (connection >= 0) take_({pending.listener, connection, pending.opening.bytes(), false});
    used_ = processorTimeOfThread();  // gRPC's work for an admitted connection is not charged to the budget
  }

  /// Passes on connections with TLS that gRPC handles; during an alarm, reads them here instead.
  void passToFreePlaces() {
    const bool is_alarmed = flood_guard::isAlarmed();
    for (auto it = pending_.begin(); it != pending_.end();) {
      const auto here = it++;
      Pending& pending = here->second;
      if (pending.state != Pending::State::waiting) continue;
      if (is_alarmed) {
        pending.tls = std::make_unique<TlsServer::Connection>(*tls_, pending.connection);
        pending.state = Pending::State::reading;
        watch(pending.connection, here->first);
        continue;
      }
      if (flood_guard::unauthorised() >= flood_guard::kMaxUnauthorised) return;
      account();
      flood_guard::admit(pending.connection, false);
      last_passed_ = Clock::now();
      const Admitted admitted{pending.listener, pending.connection, "", true};
      remove(here);
      take_(admitted);
      used_ = processorTimeOfThread();
    }
  }

  /// Handles what depends on time.
  void passTime() {
    const auto now = Clock::now();
    passToFreePlaces();
    any_waits_ = false;
    Clock::time_point waits_since = now;
    for (auto it = pending_.begin(); it != pending_.end();) {
      const auto here = it++;
      Pending& pending = here->second;
      if (pending.state == Pending::State::parked ? now - pending.parked_at >= kPenalty
                                                  : now - pending.since >= options_.opening_limit) {
        drop(here);
        continue;
      }
      const bool wants_place = pending.state == Pending::State::reading && pending.wants_place;
      if (wants_place && passToPlace(here)) continue;
      if (wants_place || pending.state == Pending::State::waiting) {
        any_waits_ = true;
        waits_since = std::min(waits_since, pending.since);
      }
    }
    if (any_waits_ && now - std::max(waits_since, last_passed_) > kStalled && !flood_guard::isAlarmed()) {
      flood_guard::raiseAlarm(listener_.address() + ": " + std::to_string(flood_guard::kMaxUnauthorised) +
                              " connections without an authorised call delay others; they are disconnected");
    }
  }

  const ConnectionListener& listener_;
  const Options options_;
  const std::function<void(Admitted)> take_;
  const int end_;
  const std::shared_ptr<TlsServer> tls_;  ///< null without TLS
  const int events_;
  const std::size_t max_pending_;
  PendingMap pending_;
  Number next_ = kFirst;
  bool accepts_later_ = false, any_waits_ = false;
  Clock::time_point last_passed_{};
  nanoseconds used_{0};  ///< processor time that has been charged
  std::array<char, 16 * 1024> buffer_{};
};

ConnectionGate::ConnectionGate(std::unique_ptr<ConnectionListener> listener, const Options& options,
                               std::function<void(Admitted)> take)
    : listener_(std::move(listener)), end_(eventfd(0, EFD_CLOEXEC)) {
  if (end_ < 0) throw std::runtime_error("cannot listen on " + listener_->address() + ": " + std::strerror(errno));
  loop_ = std::make_unique<Loop>(*listener_, options, std::move(take), end_);
  thread_ = std::thread([this] { loop_->run(); });
}

ConnectionGate::~ConnectionGate() {
  const std::uint64_t one = 1;
  if (write(end_, &one, sizeof one) == sizeof one) thread_.join();
  close(end_);
}

}  // namespace robosim
