#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/digest.h"
#include "base/parallel.h"
#include "base/sim_time.h"
#include "environment/state.h"
#include "geometry/scene.h"
#include "hardware/command.h"
#include "hardware/readings.h"
#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

struct EnvironmentOptions {
  std::uint64_t seed = 1;
  double period_s = 0.1;  ///< length of a time step, (0, 1]
  int threads = 1;        ///< the run is the same for any number
};

/// Owns the state of a world and keeps its time step. No socket, no wall clock and no global inside: the same world,
/// seed and commands give the same run, bit for bit, for any number of threads.
///
/// A time step:
///  1. take each robot's last command;
///  2. authorise and move. The rule does not depend on any order: (a) each robot's path is clipped at the first contact
///     with anything stationary, with the surface's edge, and with where every other robot *started* the step; (b) two
///     robots whose clipped paths would still touch both stay where they started (they may turn). Then no two bodies
///     overlap. Who was clipped or stayed is `stalled`;
///  3. deliver the robot messages sent since the last step: by sender (in the world's order), then as sent;
///  4. sense, everything from one frozen scene, every robot writing to its own slots only;
///  5. the result stands, read-only, for whoever looks (recorder, viewer, server) until the next step.
class Environment {
 public:
  /// Puts every robot at its start and senses once, as step 0.
  Environment(World world, Fleet fleet, const EnvironmentOptions& options);
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  const World& world() const;
  const Fleet& fleet() const;
  std::size_t robotCount() const;
  const State& state() const;
  SimTime time() const;

  /// May be called for different robots from different threads, between steps.
  void setCommand(std::size_t robot, const Command&);
  /// Queues a message for the next step. The same about threads.
  /// @throws std::invalid_argument for an unknown receiver or too long a text.
  void send(std::size_t from, const std::string& to, const std::string& text);

  void step();

  /// Whether every robot has halted or found what it looked for.
  bool allHalted() const;
  /// Hash over all states and readings of all steps so far.
  std::string digest() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
