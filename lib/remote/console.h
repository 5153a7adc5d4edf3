#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/access.h"
#include "net/tls.h"
#include "remote/map_view.h"
#include "remote/remote_control.h"

namespace robosim {

/// A team's remote control as a web page: whoever opens the page first and wants to has the wheel, and everyone else
/// looks on. What the wheel's holder does goes to the primary robot; what robots tell goes to every page, the newest
/// first, as fast as each of them can show it.
class Console {
 public:
  struct Options {
    std::string listen = "127.0.0.1:8080";  ///< "host:port"
    std::optional<TlsIdentity> tls;         ///< absent: without TLS
    Access access;                          ///< who may look, and who may drive which robots
    RemoteControl::Options control;         ///< all but `ring`
    MapSource* map = nullptr;               ///< must outlive this; null for no map
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
  };

  /// Opens the port.
  /// @throws std::runtime_error when it is taken; ConfigError as RemoteControl does.
  Console(const Options& options, const std::vector<RobotAddress>& team);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  int port() const;
  /// Serves until `interrupted` says so (asked 20 times a second at least).
  void serve(const std::function<bool()>& interrupted);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
