#pragma once
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "net/connection_listener.h"
#include "net/peer_address.h"
#include "net/pending_connections.h"

namespace robosim {

/// A connection that has been accepted.
struct AcceptedConnection {
  PendingConnections::Number number = 0;
  std::size_t port = 0;  ///< index of its ConnectionListener
  int listener = -1;     ///< the listening socket
  int socket = -1;       ///< non-blocking
  PeerAddress peer;
};

/// Accepts the connections of every port of the program, for one protocol: gRPC (ConnectionGate), the console's HTTP
/// and WebSocket (WebServer), ARCOS (ArcosServer). Does not wait, and runs on its caller's thread. Applies the limits
/// of all ports: descriptors (ConnectionListener), connections accepted in one turn, and connections that their
/// protocol has not admitted yet (PendingConnections).
class ConnectionAcceptor {
 public:
  using Number = PendingConnections::Number;
  /// Time after which the caller tries again when accept() returns false.
  static constexpr std::chrono::milliseconds kPause{100};

  struct Options {
    std::string pending;  ///< "connections without an authorised call": what the log calls those not yet admitted
    std::size_t max_pending = PendingConnections::kMax;  ///< lower where the process has few descriptors
    /// Takes over the socket of a connection, which is pending until release(). @return false to refuse it: the socket
    /// is closed
    std::function<bool(const AcceptedConnection&)> take;
    /// Closes a pending connection beyond the limit.
    std::function<void(Number)> close;
  };

  /// @param listeners may be shared with another acceptor, of which only one is in use at a time
  /// @throws std::runtime_error without a descriptor
  ConnectionAcceptor(std::vector<std::shared_ptr<const ConnectionListener>> listeners, Options options);
  ~ConnectionAcceptor();
  ConnectionAcceptor(const ConnectionAcceptor&) = delete;
  ConnectionAcceptor& operator=(const ConnectionAcceptor&) = delete;

  const std::vector<std::shared_ptr<const ConnectionListener>>& listeners() const { return listeners_; }
  /// A descriptor that can be read as long as there are connections to accept.
  int descriptor() const { return events_; }

  /// Accepts the connections that wait, at most this number, in turn from each port that has any.
  /// @return false when there are connections that cannot be accepted now
  bool accept(std::size_t most);

  /// A connection has been admitted by its protocol, or closed.
  void release(Number number) { pending_.remove(number); }
  /// A pending connection is a flood, and closed before others.
  void noteFlood(Number number) { pending_.noteFlood(number); }

 private:
  struct Socket {
    std::size_t port = 0;
    int listener = -1;
  };
  void add(const Socket& socket, int connection);

  const std::vector<std::shared_ptr<const ConnectionListener>> listeners_;
  const Options options_;
  std::vector<Socket> sockets_;
  PendingConnections pending_;
  const int events_;
};

}  // namespace robosim
