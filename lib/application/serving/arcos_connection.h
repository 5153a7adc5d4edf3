#pragma once
#include <array>
#include <memory>
#include <string>

#include <boost/asio/ip/tcp.hpp>

#include "arcos/board/arcos_session.h"

namespace robosim {

/// TCP connection of one ARCOS program: passes bytes between the socket and an ArcosSession, without waiting. Handlers
/// keep the object alive; after close() they have no effect.
class ArcosConnection : public std::enable_shared_from_this<ArcosConnection> {
 public:
  /// Bytes that may wait until the program receives them: about 100 cycles with a scan.
  static constexpr std::size_t kUnsentMax = 128 * 1024;

  ArcosConnection(boost::asio::ip::tcp::socket socket, std::string peer, ArcosBoard& board, Simulator& simulator);

  void start();
  /// Continues what depends on time, and sends what the socket accepts.
  void poll(ArcosSession::Clock::time_point now);
  void sendCycle();
  void close();

  /// Why the connection has ended, or is to be closed; empty while it lasts.
  const std::string& endReason() const;
  const std::string& peer() const { return peer_; }
  ArcosSession& session() { return session_; }

 private:
  void receive();
  void send(const std::string& bytes);
  void flush();

  boost::asio::ip::tcp::socket socket_;
  std::string peer_;
  ArcosSession session_;
  std::array<char, 4096> received_;
  std::string unsent_;
  std::string lost_;  ///< why the connection has ended without the session's doing
};

}  // namespace robosim
