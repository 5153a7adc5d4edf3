#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "net/connection_opening.h"
#include "net/peer_address.h"
#include "net/tls.h"

namespace robosim {

/// A connection before its first authorised call.
struct PendingConnection {
  using Clock = std::chrono::steady_clock;

  int listener = -1, socket = -1;
  PeerAddress peer;
  std::string network;  ///< PeerAddress::network()
  Clock::time_point since;
  ConnectionOpening opening{};                   ///< what was received, without TLS
  std::unique_ptr<TlsServer::Connection> tls{};  ///< null: without TLS, or not yet decrypted
  bool has_settings = false;                     ///< has been sent the server's SETTINGS
  bool wants_place = false;                      ///< is to be passed on before an authorised call
  std::optional<Clock::time_point> parked_at{};  ///< a flood, which is not read any further
  std::uint32_t last_checked_stream = 0;         ///< the tokens up to this call are not valid
};

/// The pending connections of one gate. The gates of the process together have at most kMax, except that each may have
/// a quarter of it, whatever the others have. Beyond it, the oldest connection of the network that has the most is
/// closed, of parked ones if there are any.
class PendingConnections {
 public:
  static constexpr std::size_t kMax = 1024;
  using Number = std::uint64_t;  ///< in the order of acceptance; from kFirst on
  using Map = std::map<Number, PendingConnection>;
  using Iterator = Map::iterator;
  static constexpr Number kFirst = 2;

  /// @param address of the gate, for the log @param max lower than kMax where the process has few descriptors
  PendingConnections(std::string address, std::size_t max);
  ~PendingConnections();
  PendingConnections(const PendingConnections&) = delete;
  PendingConnections& operator=(const PendingConnections&) = delete;

  /// Adds a socket, which this owns. @return end() for a socket that is closed at once
  Iterator add(int listener, int socket);
  /// Removes a connection without closing it.
  PendingConnection release(Iterator it);
  /// Resets a connection, so that the client's unread bytes do not delay its end.
  void drop(Iterator it);

  Iterator find(Number number) { return map_.find(number); }
  Iterator begin() { return map_.begin(); }
  Iterator end() { return map_.end(); }
  bool isEmpty() const { return map_.empty(); }

 private:
  bool dropOne();

  const std::string address_;
  const std::size_t max_, share_;
  Map map_;
  Number next_ = kFirst;
};

}  // namespace robosim
