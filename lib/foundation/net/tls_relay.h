#pragma once
#include <memory>
#include <string>

#include "net/tls.h"

namespace robosim {

/// Passes the bytes of a connection whose TLS this process terminates to gRPC, over a local socket, on a thread of its
/// own that all such connections share. Only connections that were opened during an alarm (flood_guard), or to a server
/// with public paths, are relayed: each message costs two context switches more than with gRPC's own TLS.
class TlsRelay {
 public:
  /// Starts the thread. @throws std::runtime_error or std::system_error when it cannot
  static void prepare();
  /// @param socket of the client, which this closes in the end
  /// @param tls over that socket, after its handshake
  /// @return the other end of the local socket, whose peer peerOfName() resolves to the client; -1 when there are no
  /// descriptors, and the client is disconnected
  static int start(int socket, std::shared_ptr<TlsServer> server, std::unique_ptr<TlsServer::Connection> tls);
};

}  // namespace robosim
