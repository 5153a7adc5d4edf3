#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "console/map_view.h"
#include "console/rounds.h"
#include "console/run_view.h"
#include "net/access.h"
#include "net/tls.h"
#include "remote/remote_control.h"

namespace robosim {

/// Remote control of a team as a web page. One page at a time holds the control lock, and the others observe. Orders of
/// the holder go to the primary robot. Robots' updates go to every page, newest first, at the rate that the page
/// acknowledges.
class Console {
 public:
  struct Options {
    std::string listen = "127.0.0.1:8080";  ///< "host:port"
    std::optional<TlsIdentity> tls;         ///< absent: without TLS
    Access access;                          ///< rights by token
    RemoteControl::Options control;         ///< all but `on_news`
    MapSource* map = nullptr;               ///< must outlive this; null for no map
    RunSource* run = nullptr;               ///< must outlive this; null if unknown
    std::optional<Rounds::Options> rounds;  ///< of visitors; absent: none
    std::string results;                    ///< file of the results of the day; empty: none
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
  };

  /// Opens the port.
  /// @throws std::runtime_error when it is taken; ConfigError as RemoteControl does, and for a damaged file of results.
  Console(const Options& options, const std::vector<RobotAddress>& team);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  int port() const;
  /// Serves until `interrupted` returns true (polled at least 20 times per second).
  void serve(const std::function<bool()>& interrupted);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
