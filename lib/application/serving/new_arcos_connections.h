#pragma once
#include <map>
#include <memory>
#include <vector>

#include "net/connection_acceptor.h"
#include "serving/arcos_connection.h"

namespace robosim {

/// ARCOS connections whose programs have not completed the handshake. Receives from those that have sent something, in
/// turn, so that many silent ones cost little.
class NewArcosConnections {
 public:
  using Number = ConnectionAcceptor::Number;
  static constexpr std::size_t kReadsAtOnce = 128;  ///< of all of them, up to 4 KiB each

  NewArcosConnections();  ///< @throws std::runtime_error without a descriptor
  ~NewArcosConnections();
  NewArcosConnections(const NewArcosConnections&) = delete;
  NewArcosConnections& operator=(const NewArcosConnections&) = delete;

  void add(const AcceptedConnection& accepted, std::unique_ptr<ArcosConnection> connection);
  /// Removes a connection, also the one that this receives from. @return null if it is none of these
  std::unique_ptr<ArcosConnection> take(Number number);
  /// Receives, without waiting. @return connections that have ended, which are to be taken
  std::vector<Number> receive(ArcosSession::Clock::time_point now);
  /// Checks time limits. @return connections that have ended, which are to be taken
  std::vector<Number> poll(ArcosSession::Clock::time_point now);

 private:
  struct Entry {
    int socket = -1;
    std::unique_ptr<ArcosConnection> connection;
  };
  const int events_;
  std::map<Number, Entry> connections_;
};

}  // namespace robosim
