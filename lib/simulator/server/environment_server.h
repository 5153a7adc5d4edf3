#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "environment/environment.h"
#include "environment/run_report.h"
#include "net/access.h"
#include "net/connect.h"
#include "net/listen.h"
#include "net/open_port.h"
#include "net/tls.h"
#include "server/served_run.h"
#include "server/serving_state.h"

namespace robosim {

struct ServerOptions {
  ListenAddresses listen = ListenAddresses::parse(kDefaultListen);
  Access access;                                     ///< rights by token
  std::optional<TlsIdentity> tls;                    ///< absent: without TLS
  std::chrono::milliseconds step_deadline{1000};     ///< maximum time that a step waits for a client
  std::chrono::milliseconds hello_deadline{10'000};  ///< maximum time from a call to its first message
  std::chrono::milliseconds keepalive = kKeepalive;  ///< idle time after which a client is pinged
  StandardServices standard_services;                ///< of gRPC itself, on every port
  Pace pace = Pace::lockstep;
  OnLostRobot on_lost_robot = OnLostRobot::continue_;
  double check_results = 0.01;  ///< fraction of each geometry worker's results that is recomputed, [0, 1]; at least one
  std::chrono::milliseconds load_deadline{60'000};  ///< maximum time for a control panel to send a world
  double speed = 0;                                 ///< simulated seconds per second; 0: unlimited, in lockstep only
  bool is_paused = false;
  bool awaits_next_run = false;  ///< after the end of a run, waits for a control panel to load another world or to stop
  std::function<void(const std::string&)> log = [](const std::string&) {};          ///< receives one line
  std::function<ServingState::Clock::time_point()> now = ServingState::Clock::now;  ///< clock for deadlines
};

/// Why EnvironmentServer::serve() returned.
enum class Served {
  to_its_end,   ///< the run is over
  stopped,      ///< by a control panel
  interrupted,  ///< by the `interrupted` callback
  robot_lost,   ///< OnLostRobot::fail
};

/// Serves one environment to robots, viewers, geometry workers and control panels, and steps it. Each cycle runs in the
/// order of 2005: admit new clients, apply the robots' messages, step, publish the state. Everything runs on the thread
/// that calls serve().
class EnvironmentServer {
 public:
  /// Opens the ports.
  /// @throws std::runtime_error when a port is in use, with the address and how to fix it.
  EnvironmentServer(const ServerOptions& options, std::shared_ptr<const RunInfo> run_info);
  ~EnvironmentServer();
  EnvironmentServer(const EnvironmentServer&) = delete;
  EnvironmentServer& operator=(const EnvironmentServer&) = delete;

  /// TCP ports for viewers, robots, geometry workers and control panels.
  std::array<int, 4> ports() const;

  /// Waits for the networked robots, then steps until the run is over, a control panel stops it, or `interrupted`
  /// returns true (polled at least 20 times per second). Then ends all calls and closes the ports.
  Served serve(ServedRun& run, const std::function<bool()>& interrupted);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
