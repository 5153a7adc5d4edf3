#pragma once
#include <string>

#include "arcos/board/arcos_session.h"
#include "net/connection_acceptor.h"

namespace robosim {

/// TCP connection of one ARCOS program: passes bytes between its socket and an ArcosSession, without waiting.
class ArcosConnection {
 public:
  /// Bytes that may wait until the program receives them: about 100 cycles with a scan.
  static constexpr std::size_t kUnsentMax = 128 * 1024;

  /// @param accepted whose socket this owns @param claim as of ArcosSession
  ArcosConnection(const AcceptedConnection& accepted, ArcosSession::Claim claim);
  ~ArcosConnection();
  ArcosConnection(const ArcosConnection&) = delete;
  ArcosConnection& operator=(const ArcosConnection&) = delete;

  /// Receives up to 4 KiB, if any, and answers. @return whether there may be more
  bool receive(ArcosSession::Clock::time_point now);
  /// Continues what depends on time, and sends what the socket accepts.
  void poll(ArcosSession::Clock::time_point now);
  void sendCycle();
  void send(const std::string& bytes);

  /// Why the connection has ended, or is to be closed; empty while it lasts.
  const std::string& endReason() const;
  const std::string& peer() const { return peer_; }  ///< "host:port"
  ArcosSession& session() { return session_; }

 private:
  void flush();

  const int socket_;
  const std::string peer_;
  ArcosSession session_;
  std::string unsent_;
  std::string lost_;  ///< why the connection has ended without the session's doing
};

/// "192.0.2.7:4711", "[2001:db8::1]:4711".
std::string toHostAndPort(const PeerAddress& peer);

}  // namespace robosim
