#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "net/peer_address.h"

namespace robosim {

/// The limit of the connections that their protocol has not admitted yet (ConnectionAcceptor), whose owner keeps their
/// sockets. The acceptors of the process together have at most `max`, except that each may have a quarter of it,
/// whatever the others have. Beyond it, the oldest connection of the network that has the most is closed, of floods if
/// there are any.
class PendingConnections {
 public:
  static constexpr std::size_t kMax = 1024;
  using Number = std::uint64_t;  ///< in the order of acceptance; from kFirst on
  static constexpr Number kFirst = 2;

  struct Limit {
    std::string address;  ///< where they connect, for the log
    std::string kind;     ///< "connections without an authorised call", for the log
    std::size_t max = kMax;
  };
  /// @param close closes a connection, which has been removed
  PendingConnections(Limit limit, std::function<void(Number)> close);
  ~PendingConnections();  ///< closes none
  PendingConnections(const PendingConnections&) = delete;
  PendingConnections& operator=(const PendingConnections&) = delete;

  /// @return nullopt if there is no place
  std::optional<Number> add(const PeerAddress& peer);
  /// A connection has been admitted, or closed. No effect for others
  void remove(Number number);
  /// A connection is one of the first to be closed.
  void noteFlood(Number number);
  /// Closes the connection that leaves for the next one. @return its peer; nullopt if there is none
  std::optional<PeerAddress> closeOne();

 private:
  struct Connection {
    PeerAddress peer;
    bool is_flood = false;
  };
  /// The connections of a network.
  struct Network {
    std::set<Number> floods, others;
    std::size_t size() const { return floods.size() + others.size(); }
  };
  Number worst() const;

  const Limit limit_;
  const std::size_t share_;
  const std::function<void(Number)> close_;
  std::map<Number, Connection> connections_;
  std::map<std::string, Network> networks_;  ///< by PeerAddress::network(); none is empty
  std::size_t floods_ = 0;
  Number next_ = kFirst;
};

}  // namespace robosim
