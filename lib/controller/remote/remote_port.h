#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/access.h"
#include "net/tls.h"
#include "remote/remote_control_robot.h"

namespace robosim {

/// Server of the RemoteControl service for the robots of a process (remote.proto; protocol: doc/protocol.md). Each
/// robot accepts any number of observers and one driver: the first to request it, until that driver disconnects.
class RemotePort {
 public:
  struct Options {
    std::string listen = "127.0.0.1:0";                                       ///< "host:port"
    Access access;                                                            ///< rights by token
    std::optional<TlsIdentity> tls;                                           ///< absent: without TLS
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line, from any thread
    std::chrono::milliseconds init_deadline{10'000};                          ///< maximum time from a call to its INIT
  };

  /// State common to all robots of the process.
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

  /// Sends the requested readings to all remote controls; called after each step by the thread that steps the robots.
  /// Does not block.
  /// @param received message from which the robots' readings of this step were decoded, with the robots in the
  /// constructor's order: it is forwarded. Null: the readings are encoded
  void publish(const v1::StepReadings* received = nullptr);
  /// Whether a remote control showed the readings of a robot, with its pictures, in the last publish(). Called by the
  /// same thread. @param robot in the constructor's order
  bool isWatched(std::size_t robot) const;
  /// Ends all calls, because the run is over.
  void endRun();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
