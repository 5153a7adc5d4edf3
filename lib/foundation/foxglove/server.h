#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foxglove/hub.h"
#include "net/access.h"
#include "net/tls.h"

namespace robosim::foxglove {

/// Server of Foxglove's WebSocket protocol: a Hub behind a WebServer, in a thread of its own, so that neither clients
/// nor their connections delay the source of the messages.
class Server {
 public:
  struct Options {
    std::string listen = "127.0.0.1:8765";  ///< "host:port"
    std::optional<TlsIdentity> tls;         ///< absent: without TLS
    Access access;                          ///< rights by token
    std::vector<std::string> origins;       ///< of pages that may connect besides those of mayConnect()
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line; thread-safe
    PublicationHandler* publications = nullptr;                               ///< as Hub::Options::publications
  };

  /// Opens the port, and serves from now on.
  /// @throws std::runtime_error when the port cannot be opened, and why
  explicit Server(const Options& options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;
  Hub& hub();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether a client may connect, by the headers of its request. Programs other than browsers send no origin, and are
/// not restricted by it. Pages must be of this server, of Foxglove's application, or of `origins`; pages of other sites
/// in the same browser are refused. For a server on a loopback address, `host` must name this machine, which prevents
/// DNS rebinding.
bool mayConnect(const std::string& origin, const std::string& host, const std::string& listen,
                const std::vector<std::string>& origins);

}  // namespace robosim::foxglove
