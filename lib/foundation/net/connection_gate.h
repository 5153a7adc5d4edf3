#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "net/access.h"
#include "net/connection_listener.h"
#include "net/tls.h"

namespace robosim {

/// Accepts the connections of one address (ConnectionAcceptor), and passes each to gRPC after its first authorised
/// call: on a thread of its own, so that what clients send before does not delay the thread that steps the environment.
/// The gates of the process together use at most kProcessorShare of one processor.
///
/// A call is authorised by a valid token in its headers or, where no tokens are required, by the beginning of its
/// message. A connection that sends anything else to excess (ConnectionOpening) is a flood: it is not read any further,
/// and is reset after kPenalty. Without an alarm (flood_guard), up to flood_guard::kMaxUnauthorised connections pass
/// before an authorised call, so that a session reports why it refuses a call, and with TLS so that gRPC handles TLS
/// itself; these after their first byte. During an alarm the gate terminates TLS (TlsRelay). Connections of banned
/// networks are read last.
///
/// All bytes that were received are passed on. The gate sends its own SETTINGS, which clients await before their first
/// call; gRPC's own follow later.
class ConnectionGate {
 public:
  static constexpr double kProcessorShare = 0.2;
  static constexpr std::chrono::milliseconds kBurst{50};  ///< of processor time
  static constexpr std::chrono::seconds kPenalty{2};

  struct Options {
    Access access;                            ///< rights by token
    std::optional<TlsIdentity> tls;           ///< nullopt: without TLS
    std::chrono::milliseconds opening_limit;  ///< maximum time until the first call
    std::vector<std::string> public_paths{};  ///< beginnings of paths that require no token
  };
  /// A connection that gRPC takes over.
  struct Admitted {
    int listener = -1;
    int connection = -1;
    std::string received;       ///< bytes already read, without TLS
    bool is_encrypted = false;  ///< whether gRPC handles TLS
  };

  /// @param take receives the admitted connections, on the gate's thread
  ConnectionGate(std::shared_ptr<const ConnectionListener> listener, const Options& options,
                 std::function<void(Admitted)> take);
  ~ConnectionGate();  ///< closes the port and the pending connections
  ConnectionGate(const ConnectionGate&) = delete;
  ConnectionGate& operator=(const ConnectionGate&) = delete;

  int port() const { return listener_->port(); }

 private:
  class Loop;
  const std::shared_ptr<const ConnectionListener> listener_;
  int end_ = -1;  ///< an eventfd that stops the thread
  std::unique_ptr<Loop> loop_;
  std::thread thread_;
};

}  // namespace robosim
