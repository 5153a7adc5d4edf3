#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "environment/environment.h"

namespace robosim {

struct ArcosOptions {
  std::string listen = "127.0.0.1:8101";  ///< "host:port" of the first robot; the others have the ports that follow.
                                          ///< With port 0 the system chooses each
  std::string factory = {};               ///< robot type; if given: one port; the robots are absent, and each program
                                          ///< gets one that comes to its start, or is added, and leaves with it
  std::size_t factory_most = 0;           ///< robots of that type, with the one that the run has from its start
  bool has_all = false;                   ///< also serve robots that have a controller
  double speed = 1;                       ///< simulated seconds per second, for SIMSTAT
  bool may_load_maps = false;             ///< programs may load another map, for all programs and clients of the run
  std::string map_file = {};              ///< of the world, for the answers to requests for maps
  bool isFactory() const { return !factory.empty(); }
  std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
};

/// Serves robots of a run to programs that speak ARCOS, such as those of ARIA (doc/arcos.md). Each robot is driven by
/// an ArcosBoard; programs get its packets after each cycle of 0.1 s of simulated time. A program that floods, stalls,
/// or sends what is no packet loses its own connection only. Connections are accepted by a ConnectionAcceptor, and
/// claim a robot by the handshake.
///
/// All functions are called by the thread that steps the environment; none of them waits.
class ArcosServer {
 public:
  /// Opens the ports; accepts programs from the first poll() on.
  /// @param environment must outlive this @param robots indices; their types have arcos::Parameters
  /// @param previous server of the run before, with the same options: ports that it has open are shared with it, so
  /// that this server can be complete before that one ends. Null for none
  /// @throws std::runtime_error when a port is in use, with the address and how to fix it
  ArcosServer(const ArcosOptions& options, Environment& environment, const std::vector<std::size_t>& robots,
              const ArcosServer* previous = nullptr);
  ~ArcosServer();
  ArcosServer(const ArcosServer&) = delete;
  ArcosServer& operator=(const ArcosServer&) = delete;

  /// The map that a program has asked for, once: the caller loads it, and answers by takePrograms() of the server of
  /// the next run or by refuseMap(). nullopt if there is none, or it has been taken and is not answered.
  std::optional<std::string> takeMapRequest();
  /// Answers the programs that have asked for a map that the one in use stays, and logs why.
  void refuseMap(const std::string& why);
  /// Continues the sessions of the programs of a previous server with the robots of this one: at each port, if the
  /// robot is of the same type; with a factory, as many as get a robot. All receive that the map has changed. The
  /// others' connections end with that server.
  void takePrograms(ArcosServer& previous);

  /// Serves robots that have been added to a run with a factory, if it does not yet.
  void addRobots(const std::vector<std::size_t>& robots);

  /// TCP port of each robot, in the order of the constructor.
  std::vector<int> ports() const;
  std::size_t clients() const;

  /// Accepts programs, receives and answers. To be called often, at least every kPollInterval.
  void poll();
  static constexpr std::chrono::milliseconds kPollInterval{10};
  /// Commands the robots, immediately before a step.
  void decide();
  /// Sends the packets of a cycle, after a step.
  void stepped();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether an ARCOS program may drive a robot: its type has arcos::Parameters, and it has no controller, unless
/// ArcosOptions::has_all. A robot without a model stands for those of all types with arcos::Parameters.
/// @param has_controller whether every robot has one, whatever the world says
bool isForArcos(const FleetRobot& robot, const ArcosOptions& options, bool has_controller);

}  // namespace robosim
