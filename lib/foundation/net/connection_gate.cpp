#include "net/connection_gate.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <poll.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "net/connection_acceptor.h"
#include "net/connection_opening.h"
#include "net/flood_guard.h"
#include "net/net_log.h"
#include "net/processor_budget.h"
#include "net/tls_relay.h"

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

ProcessorBudget& budgetOfAllGates() {
  static auto* const budget = new ProcessorBudget(ConnectionGate::kProcessorShare, ConnectionGate::kBurst);
  return *budget;
}

/// The server's first frame, which a client awaits before its first call: SETTINGS with
/// SETTINGS_MAX_CONCURRENT_STREAMS (3).
constexpr std::array<char, 15> kSettings{0, 0, 6, 4, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, ConnectionOpening::kMaxCalls};

/// First byte of a TLS handshake (RFC 8446, section 5.1).
constexpr char kTlsHandshake = 0x16;

}  // namespace

/// The thread of a gate.
class ConnectionGate::Loop {
 public:
  Loop(const std::shared_ptr<const ConnectionListener>& listener, const Options& options,
       std::function<void(Admitted)> take, int end)
      : address_(listener->address()),
        options_(options),
        take_(std::move(take)),
        end_(end),
        tls_(options.tls ? std::make_shared<TlsServer>(*options.tls) : nullptr),
        events_(epoll_create1(EPOLL_CLOEXEC)),
        acceptor_({listener}, {.pending = "connections without an authorised call",
                               .take =
                                   [this](const AcceptedConnection& accepted) {
                                     add(accepted);
                                     return true;
                                   },
                               .close = [this](Number number) { drop(pending_.find(number)); }}) {
    if (events_ < 0) throw std::runtime_error("cannot listen on " + address_ + ": " + std::strerror(errno));
    if (tls_) TlsRelay::prepare();
    watch(EPOLL_CTL_ADD, end_, kEnd, EPOLLIN);
    watch(EPOLL_CTL_ADD, acceptor_.descriptor(), kListener, EPOLLIN);
  }
  ~Loop() {
    for (auto& [number, connection] : pending_) {
      connection.tls.reset();
      close(connection.accepted.socket);
    }
    close(events_);
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void run() {
    used_ = processorTimeOfThread();
    std::vector<epoll_event> ready(PendingConnections::kMax);
    std::vector<Number> readable;
    for (;;) {
      if (const auto wait = budgetOfAllGates().wait(Clock::now()); wait.count() > 0 && isEndedWithin(wait)) return;
      const int count = epoll_wait(events_, ready.data(), static_cast<int>(ready.size()), timeoutMs());
      if (count < 0 && errno != EINTR) return;
      readable.clear();
      for (int i = 0; i < count; ++i) {
        const Number number = ready[static_cast<std::size_t>(i)].data.u64;  // a copy, because epoll_event is packed
        readable.push_back(number);
      }
      if (std::find(readable.begin(), readable.end(), kEnd) != readable.end()) return;
      if (!acceptor_.accept(kAcceptsAtOnce) && isEndedWithin(ConnectionAcceptor::kPause)) return;
      readAll(readable);
      passTime();
      account();
    }
  }

 private:
  using Number = ConnectionAcceptor::Number;
  /// A connection before its first authorised call.
  struct Pending {
    AcceptedConnection accepted;
    std::string network;  ///< PeerAddress::network()
    Clock::time_point since;
    ConnectionOpening opening{};                   ///< what was received, without TLS
    std::unique_ptr<TlsServer::Connection> tls{};  ///< null: without TLS, or not yet decrypted
    bool has_settings = false;                     ///< has been sent the server's SETTINGS
    bool wants_place = false;                      ///< is to be passed on before an authorised call
    std::optional<Clock::time_point> parked_at{};  ///< a flood, which is not read any further
    std::uint32_t last_checked_stream = 0;         ///< the tokens up to this call are not valid
  };
  using Iterator = std::map<Number, Pending>::iterator;
  static constexpr Number kEnd = 0, kListener = 1;
  static_assert(kListener < PendingConnections::kFirst);
  static constexpr std::size_t kAcceptsAtOnce = 64;
  static constexpr std::chrono::seconds kStalled{1};

  void watch(int operation, int descriptor, Number number, std::uint32_t what) const {
    epoll_event event{};
    event.events = what;
    event.data.u64 = number;
    epoll_ctl(events_, operation, descriptor, &event);
  }
  /// Reports from now on only that the client has closed the connection.
  void watchForEnd(Iterator it) const { watch(EPOLL_CTL_MOD, it->second.accepted.socket, it->first, EPOLLRDHUP); }

  bool isEndedWithin(std::chrono::milliseconds wait) const {
    pollfd end{end_, POLLIN, 0};
    return poll(&end, 1, static_cast<int>(wait.count())) > 0;
  }
  int timeoutMs() const {
    constexpr int kPlaceCheckMs = 10, kDeadlineCheckMs = 50;
    if (any_wants_place_) return kPlaceCheckMs;
    return pending_.empty() ? -1 : kDeadlineCheckMs;
  }
  /// Charges the processor time since the last call to the budget.
  void account() {
    const auto now = processorTimeOfThread();
    budgetOfAllGates().spend(now - std::exchange(used_, now), Clock::now());
  }

  void add(const AcceptedConnection& accepted) {
    watch(EPOLL_CTL_ADD, accepted.socket, accepted.number, EPOLLIN | EPOLLRDHUP);
    Pending& pending =
        pending_.try_emplace(accepted.number, Pending{accepted, accepted.peer.network(), Clock::now()}).first->second;
    if (!tls_) sendSettings(pending);
  }
  /// Removes a connection without closing it.
  Pending release(Iterator it) {
    acceptor_.release(it->first);
    Pending pending = std::move(it->second);
    pending_.erase(it);
    return pending;
  }
  /// Resets a connection, so that the client's unread bytes do not delay its end.
  void drop(Iterator it) {
    Pending pending = release(it);
    pending.tls.reset();
    const linger at_once{1, 0};
    setsockopt(pending.accepted.socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    close(pending.accepted.socket);
  }

  /// Clients may wait for SETTINGS before they send anything: gRPC's client does not read otherwise between attempts to
  /// connect.
  static void sendSettings(Pending& pending) {
    const std::string_view settings(kSettings.data(), kSettings.size());
    pending.has_settings = true;
    if (pending.tls) {
      pending.tls->write(settings);
    } else if (send(pending.accepted.socket, settings.data(), settings.size(), MSG_NOSIGNAL) < 0) {
      return;  // the next read reports it
    }
  }

  /// Reads connections in turn, those of banned networks last, as far as the budget permits. The others are reported
  /// again.
  void readAll(std::vector<Number>& readable) {
    std::erase(readable, kListener);
    if (readable.empty()) return;
    std::sort(readable.begin(), readable.end());
    std::rotate(readable.begin(), std::upper_bound(readable.begin(), readable.end(), last_read_), readable.end());
    if (flood_guard::isAlarmed()) {
      std::stable_partition(readable.begin(), readable.end(), [&](Number number) {
        const auto found = pending_.find(number);
        return found != pending_.end() && !flood_guard::isBanned(found->second.network);
      });
    }
    for (const Number number : readable) {
      const auto found = pending_.find(number);
      if (found == pending_.end()) continue;
      last_read_ = number;
      read(found);
      account();
      if (budgetOfAllGates().wait(Clock::now()).count() > 0) return;
    }
  }

  void read(Iterator it) {
    Pending& pending = it->second;
    if (pending.parked_at) {  // only its end is reported
      drop(it);
      return;
    }
    const bool is_raw = tls_ && !pending.tls;
    const ssize_t size = pending.tls
                             ? pending.tls->read(buffer_)
                             : recv(pending.accepted.socket, buffer_.data(), buffer_.size(), is_raw ? MSG_PEEK : 0);
    const bool would_wait = pending.tls ? size == 0 : size < 0 && (errno == EAGAIN || errno == EINTR);
    if (would_wait) {
      if (pending.tls && pending.tls->isEstablished() && !pending.has_settings) sendSettings(pending);
    } else if (size <= 0) {
      drop(it);
    } else if (is_raw) {
      passRaw(it, buffer_.front());
    } else {
      if (!pending.has_settings) sendSettings(pending);
      add(it, {buffer_.data(), static_cast<std::size_t>(size)});
    }
  }

  /// Handles the first byte of a connection with TLS, which has only been peeked at.
  void passRaw(Iterator it, char first) {
    if (it->second.wants_place) {  // the client has closed it meanwhile
      drop(it);
    } else if (first != kTlsHandshake) {
      refuse(it, "connections without TLS", "it does not begin with TLS; does the client lack --tls-ca?");
    } else {
      it->second.wants_place = true;
      watchForEnd(it);
      passToPlace(it);
    }
  }

  /// Adds received bytes without TLS.
  void add(Iterator it, std::string_view bytes) {
    Pending& pending = it->second;
    switch (pending.opening.add(bytes)) {
      case ConnectionOpening::Verdict::valid:
        break;
      case ConnectionOpening::Verdict::no_http2:
        refuse(it, "connections without HTTP/2",
               "it does not begin with HTTP/2; does the client expect TLS, and is the server started without "
               "--tls-cert?");
        return;
      case ConnectionOpening::Verdict::invalid:
        refuse(it, "connections with invalid HTTP/2", "its frames do not follow RFC 9113");
        return;
      case ConnectionOpening::Verdict::excess:
        if (isAuthorised(pending)) return pass(it, true);
        flood_guard::reportFlood(pending.accepted.peer, "floods the server with HTTP/2 frames");
        park(it);
        return;
    }
    if (isAuthorised(pending)) {
      pass(it, true);
    } else if (!pending.opening.calls().empty()) {
      pending.wants_place = true;
      passToPlace(it);
    }
  }

  void refuse(Iterator it, const std::string& log_kind, const std::string& why) {
    logFromNet(log_kind, address_ + ": " + it->second.accepted.peer.host + ": connection closed: " + why);
    drop(it);
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
      if (options_.access.authenticateHeader(call.token, pending.accepted.peer.grpcName()).status.ok()) return true;
    }
    return false;
  }

  /// Passes on a connection without an authorised call, if there is a place for it. During an alarm there is none:
  /// reads what is encrypted, and parks what has no valid token. Of a server with public paths, it reads what is
  /// encrypted at any time.
  void passToPlace(Iterator it) {
    Pending& pending = it->second;
    const bool is_raw = tls_ && !pending.tls;
    // gRPC answers calls of public paths itself, so that only the gate can authorise their connections.
    const bool is_alarmed = flood_guard::isAlarmed();
    if (is_raw && (is_alarmed || !options_.public_paths.empty())) {
      pending.wants_place = false;
      pending.tls = std::make_unique<TlsServer::Connection>(*tls_, pending.accepted.socket);
      watch(EPOLL_CTL_MOD, pending.accepted.socket, it->first, EPOLLIN | EPOLLRDHUP);
    } else if (!is_alarmed) {
      if (flood_guard::unauthorised() < flood_guard::kMaxUnauthorised) {
        pass(it, false);
      } else {
        any_wants_place_ = true;
      }
    } else if (!options_.access.isOpen()) {  // else its message may follow
      park(it);
    }
  }

  void park(Iterator it) {
    Pending& pending = it->second;
    watchForEnd(it);
    acceptor_.noteFlood(it->first);
    pending.parked_at = Clock::now();
    pending.opening = {};
    pending.tls.reset();
    pending.wants_place = false;
  }

  void pass(Iterator it, bool is_authorised) {
    account();
    Pending pending = release(it);
    epoll_ctl(events_, EPOLL_CTL_DEL, pending.accepted.socket, nullptr);
    flood_guard::admit(pending.accepted.socket, is_authorised);
    Admitted admitted{.listener = pending.accepted.listener,
                      .connection = pending.accepted.socket,
                      .received = pending.opening.bytes(),
                      .is_encrypted = tls_ && !pending.tls};
    if (pending.tls) admitted.connection = TlsRelay::start(pending.accepted.socket, tls_, std::move(pending.tls));
    last_passed_ = Clock::now();
    if (admitted.connection >= 0) take_(admitted);
    used_ = processorTimeOfThread();  // gRPC's work for an admitted connection is not charged to the budget
  }

  /// Handles what depends on time.
  void passTime() {
    const auto now = Clock::now();
    any_wants_place_ = false;
    for (auto it = pending_.begin(); it != pending_.end();) {
      const auto here = it++;
      const Pending& pending = here->second;
      if (pending.parked_at ? now - *pending.parked_at >= kPenalty : now - pending.since >= options_.opening_limit) {
        drop(here);
      } else if (pending.wants_place) {
        passToPlace(here);
      }
    }
    if (!any_wants_place_) {
      stalled_since_.reset();
    } else if (now - std::max(stalled_since_.value_or(now), last_passed_) > kStalled) {
      flood_guard::raiseAlarm(address_ + ": " + std::to_string(flood_guard::kMaxUnauthorised) +
                              " connections without an authorised call delay others, and are disconnected");
    } else if (!stalled_since_) {
      stalled_since_ = now;
    }
  }

  const std::string address_;
  const Options options_;
  const std::function<void(Admitted)> take_;
  const int end_;
  const std::shared_ptr<TlsServer> tls_;  ///< null without TLS
  const int events_;
  ConnectionAcceptor acceptor_;
  std::map<Number, Pending> pending_;  ///< by AcceptedConnection::number
  Number last_read_ = 0;
  bool any_wants_place_ = false;
  std::optional<Clock::time_point> stalled_since_;  ///< connections have waited for a place since then
  Clock::time_point last_passed_{};
  nanoseconds used_{0};  ///< processor time that has been charged
  std::array<char, 16 * 1024> buffer_{};
};

ConnectionGate::ConnectionGate(std::shared_ptr<const ConnectionListener> listener, const Options& options,
                               std::function<void(Admitted)> take)
    : listener_(std::move(listener)), end_(eventfd(0, EFD_CLOEXEC)) {
  if (end_ < 0) throw std::runtime_error("cannot listen on " + listener_->address() + ": " + std::strerror(errno));
  loop_ = std::make_unique<Loop>(listener_, options, std::move(take), end_);
  thread_ = std::thread([this] { loop_->run(); });
}

ConnectionGate::~ConnectionGate() {
  const std::uint64_t one = 1;
  if (write(end_, &one, sizeof one) == sizeof one) thread_.join();
  close(end_);
}

}  // namespace robosim
