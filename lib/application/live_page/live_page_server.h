#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "live_page/live_page_hub.h"
#include "net/access.h"
#include "net/tls.h"

namespace robosim {

/// Server of the page of a run: a LivePageHub behind a WebServer, in a thread of its own, so that neither pages nor
/// their connections delay the run.
class LivePageServer {
 public:
  struct Options {
    std::string listen = "127.0.0.1:8081";                                    ///< "host:port"
    std::optional<TlsIdentity> tls;                                           ///< absent: without TLS
    Access access;                                                            ///< rights by token
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line; thread-safe
  };

  /// Opens the port, and serves from now on.
  /// @throws std::runtime_error when the port cannot be opened, and why
  explicit LivePageServer(const Options& options);
  /// Pages receive what waits for them, unless they are slow.
  ~LivePageServer();
  LivePageServer(const LivePageServer&) = delete;
  LivePageServer& operator=(const LivePageServer&) = delete;

  int port() const;
  LivePageHub& hub();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Address of --web, "host:port"; a host without a port gets 8081. @throws ConfigError
std::string livePageAddress(const std::string& address);
/// Line of the log that names the page, with the port that was chosen.
std::string livePageLine(const LivePageServer::Options& options, int port);

}  // namespace robosim
