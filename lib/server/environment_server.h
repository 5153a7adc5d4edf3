#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "environment/environment.h"
#include "net/access.h"
#include "net/dial.h"
#include "net/listen.h"
#include "net/tls.h"
#include "server/lobby.h"

namespace robosim {

struct ServerOptions {
  ListenAddresses listen = ListenAddresses::parse(kDefaultListen);
  Access access;                                     ///< who may do what
  std::optional<TlsIdentity> tls;                    ///< absent: without TLS
  std::chrono::milliseconds step_deadline{1000};     ///< how long a step waits for anybody
  std::chrono::milliseconds hello_deadline{10'000};  ///< how long a client may take to say who it is
  std::chrono::milliseconds keepalive = kKeepalive;  ///< after which a silent machine is asked whether it is there
  Pace pace = Pace::lockstep;
  double speed = 0;  ///< simulated seconds a second; 0: as fast as it can, in lockstep only
  bool is_paused = false;
  std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
  std::function<Lobby::Clock::time_point()> now = Lobby::Clock::now;        ///< what tells deadlines
};

/// A run as its server needs it: the environment, and what the program does besides in each step.
class ServedRun {
 public:
  virtual ~ServedRun() = default;
  virtual Environment& environment() = 0;
  /// What is shown of it.
  virtual std::shared_ptr<const Exhibit> exhibit() const = 0;
  /// Lets the environment's own controllers decide; just before a step.
  virtual void decide() = 0;
  /// A step was taken, for which the commands of `late` robots came too late: records it, say.
  virtual void stepped(std::size_t late) = 0;
  virtual bool isOver() const = 0;
  /// Begins another run, with another world. Whoever holds the exhibit so far may go on looking at it.
  /// @throws ConfigError when the world is no good; this run then goes on.
  virtual void load(const WorldSource& world) = 0;
};

/// How serving came to its end.
enum class Served {
  to_its_end,   ///< the run's own
  stopped,      ///< from a control panel
  interrupted,  ///< by whoever started it
};

/// Shows one environment to its clients: robots, viewers, geometry workers and control panels; and lets it step, in
/// the order of 2005: admit who has come, take the robots' messages, step, tell everyone. All of it happens on the
/// thread that serves.
class EnvironmentServer {
 public:
  /// Opens the ports.
  /// @throws std::runtime_error when a port is taken; what, where and the mend.
  EnvironmentServer(const ServerOptions& options, std::shared_ptr<const Exhibit> exhibit);
  ~EnvironmentServer();
  EnvironmentServer(const EnvironmentServer&) = delete;
  EnvironmentServer& operator=(const EnvironmentServer&) = delete;

  /// The ports in use: viewers', robots', geometry's, control's.
  std::array<int, 4> ports() const;

  /// Waits for the networked robots, then steps until the run is over, a control panel stops it, or `interrupted` says
  /// so (asked 20 times a second at least); then says goodbye to everyone, and closes the ports.
  Served serve(ServedRun& run, const std::function<bool()>& interrupted);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
