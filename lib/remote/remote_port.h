#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/access.h"
#include "net/tls.h"
#include "remote/remote_control_robot.h"

namespace robosim {

/// Where the robots of a process listen for their remote controls (remote.proto; doc/protocol.md tells the
/// conversation). Any number may look on; whoever came first, and wants to, has the robot, until they hang up.
class RemotePort {
 public:
  struct Options {
    std::string listen = "127.0.0.1:0";                                       ///< "host:port"
    Access access;                                                            ///< who may do what
    std::optional<TlsIdentity> tls;                                           ///< absent: without TLS
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line, from any thread
  };

  /// What all the robots of the process have in common.
  struct Run {
    std::string world;
    std::uint64_t seed = 0;
    double period_s = 0;
  };

  /// Opens the port.
  /// @param robots must outlive this
  /// @throws std::runtime_error when the port is taken.
  RemotePort(const Options& options, const Run& run, const std::vector<RemoteControlRobot*>& robots);
  ~RemotePort();
  RemotePort(const RemotePort&) = delete;
  RemotePort& operator=(const RemotePort&) = delete;

  int port() const;

  /// Sends everyone what they have asked for: after each step, by the thread that steps the robots. Never waits for a
  /// remote control.
  void tell();
  /// The run is over: says so to everyone.
  void sayGoodbye();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
