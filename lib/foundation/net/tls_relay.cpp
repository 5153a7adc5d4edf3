#include "net/tls_relay.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "net/connection_listener.h"
#include "net/net_log.h"
#include "net/peer_address.h"

namespace robosim {
namespace {

constexpr std::size_t kBuffer = 16 * 1024;

/// Bytes on their way in one direction.
struct Buffered {
  std::array<char, kBuffer> bytes;
  std::size_t begin = 0, end = 0;
  bool isEmpty() const { return begin == end; }
  std::string_view rest() const { return {bytes.data() + begin, end - begin}; }
};

struct Relayed {
  Relayed(int the_socket, int the_local, std::shared_ptr<TlsServer> the_server,
          std::unique_ptr<TlsServer::Connection> the_tls)
      : socket(the_socket), local(the_local), server(std::move(the_server)), tls(std::move(the_tls)) {}
  ~Relayed() {
    tls.reset();
    close(socket);
    close(local);
  }
  Relayed(const Relayed&) = delete;
  Relayed& operator=(const Relayed&) = delete;

  enum class Pumped { waits, has_more, ended };

  /// Passes on what can be passed on without waiting, in both directions; has_more: after kRounds, as other connections
  /// have their turn.
  Pumped pump() {
    constexpr int kRounds = 16;
    // Events are edge-triggered, so that each direction continues until it would wait.
    bool has_moved = true;
    for (int round = 0; has_moved; ++round) {
      if (round == kRounds) return Pumped::has_more;
      has_moved = false;
      if (to_server.isEmpty()) {
        const int size = tls->read(to_server.bytes);
        if (size < 0) return Pumped::ended;
        to_server.begin = 0;
        to_server.end = static_cast<std::size_t>(size);
      }
      if (!to_server.isEmpty()) {
        const ssize_t size = send(local, to_server.rest().data(), to_server.rest().size(), MSG_NOSIGNAL);
        if (size < 0 && errno != EAGAIN) return Pumped::ended;
        if (size > 0) to_server.begin += static_cast<std::size_t>(size);
        has_moved = size > 0;
      }
      if (to_client.isEmpty()) {
        const ssize_t size = recv(local, to_client.bytes.data(), to_client.bytes.size(), 0);
        if (size == 0) tls->close();
        if (size == 0 || (size < 0 && errno != EAGAIN)) return Pumped::ended;
        to_client.begin = 0;
        to_client.end = size > 0 ? static_cast<std::size_t>(size) : 0;
      }
      if (!to_client.isEmpty()) {
        const int size = tls->write(to_client.rest());
        if (size < 0) return Pumped::ended;
        to_client.begin += static_cast<std::size_t>(size);
        has_moved = has_moved || size > 0;
      }
    }
    return Pumped::waits;
  }

  int socket, local;
  std::shared_ptr<TlsServer> server;
  std::unique_ptr<TlsServer::Connection> tls;
  Buffered to_server, to_client;
};

/// The thread of all relayed connections.
class RelayThread {
 public:
  RelayThread() : events_(epoll_create1(EPOLL_CLOEXEC)) {
    if (events_ < 0)
      throw std::runtime_error(std::string("cannot relay connections with TLS: ") + std::strerror(errno));
    std::thread([this] { run(); }).detach();
  }
  void add(std::unique_ptr<Relayed> relayed) {
    const std::lock_guard lock(mutex_);
    const std::uint64_t number = next_++;
    Relayed& added = *relayed;
    relayed_[number] = std::move(relayed);
    for (const int descriptor : {added.socket, added.local}) watch(EPOLL_CTL_ADD, descriptor, number);
  }

 private:
  /// Adds a descriptor, or again reports its present state at once.
  void watch(int operation, int descriptor, std::uint64_t number) const {
    epoll_event event{};
    event.events = EPOLLIN | EPOLLOUT | EPOLLET;
    event.data.u64 = number;
    epoll_ctl(events_, operation, descriptor, &event);
  }
  [[noreturn]] void run() {
    std::array<epoll_event, 64> ready;
    for (;;) {
      const int count = epoll_wait(events_, ready.data(), static_cast<int>(ready.size()), -1);
      const std::lock_guard lock(mutex_);
      for (int i = 0; i < count; ++i) {
        const std::uint64_t number =
            ready[static_cast<std::size_t>(i)].data.u64;  // a copy, because epoll_event is packed
        const auto found = relayed_.find(number);
        if (found == relayed_.end()) continue;
        const auto pumped = found->second->pump();
        if (pumped == Relayed::Pumped::has_more) watch(EPOLL_CTL_MOD, found->second->socket, found->first);
        if (pumped == Relayed::Pumped::ended) relayed_.erase(found);
      }
    }
  }

  const int events_;
  std::mutex mutex_;
  std::uint64_t next_ = 0;
  std::map<std::uint64_t, std::unique_ptr<Relayed>> relayed_;
};

/// Never destroyed: its thread runs until the process ends.
RelayThread& relayThread() {
  static auto* const thread = new RelayThread;
  return *thread;
}

/// Gives a socket an abstract address.
bool bindAbstract(int socket, const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.size() + 1 > sizeof address.sun_path) return false;
  std::memcpy(address.sun_path + 1, name.data(), name.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return bind(socket, reinterpret_cast<const sockaddr*>(&address), size) == 0;
}

/// @return false when there are no descriptors for connections
bool openLocalPair(std::array<int, 2>& ends) {
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends.data()) != 0) return false;
  if (std::none_of(ends.begin(), ends.end(), ConnectionListener::isReserved)) return true;
  for (const int end : ends) close(end);
  logFromNet("connections refused", "a connection with TLS is refused: the limit of " +
                                        std::to_string(ConnectionListener::descriptors()) +
                                        " descriptors is reached (ulimit -Hn; at most " +
                                        std::to_string(ConnectionListener::kMaxDescriptors) + ")");
  return false;
}

}  // namespace

void TlsRelay::prepare() { relayThread(); }

int TlsRelay::start(int socket, std::shared_ptr<TlsServer> server, std::unique_ptr<TlsServer::Connection> tls) {
  static std::atomic<std::uint64_t> number{0};
  const auto peer = PeerAddress::of(socket);
  std::array<int, 2> ends{-1, -1};
  if (!peer || !openLocalPair(ends)) {
    tls.reset();
    close(socket);
    return -1;
  }
  tls->continueAfterControlRecords();
  auto relayed = std::make_unique<Relayed>(socket, ends[0], std::move(server), std::move(tls));
  if (!bindAbstract(ends[0], relayedPeerName(*peer, number++))) {
    close(ends[1]);
    return -1;
  }
  relayThread().add(std::move(relayed));
  return ends[1];
}

}  // namespace robosim
