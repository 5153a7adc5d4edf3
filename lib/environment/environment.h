#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/digest.h"
#include "base/parallel.h"
#include "base/sim_time.h"
#include "environment/robot_range.h"
#include "environment/state.h"
#include "geometry/scene.h"
#include "hardware/command.h"
#include "hardware/readings.h"
#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// All that the moves and readings of coming steps depend on, but for what sensors remember: what a replica of an
/// environment begins from. Arrays are indexed by robot.
struct Moment {
  std::uint64_t step = 0;
  std::vector<mrpt::math::TPose2D> world_from_robot;
  std::vector<double> speed_mps;
  std::vector<double> turn_radps;
  std::vector<Activity> activity;
  std::vector<Command> commands;
};

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
///  5. decide whether a robot that has asked (CheckWin) is near enough to the gold: then it has won, every robot is
///  told
///     so, and all halt (referee.h);
///  6. the result stands, read-only, for whoever looks (recorder, viewer, server) until the next step.
class Environment {
 public:
  /// Puts every robot at its start and senses once, as step 0.
  /// @param images for the robots' cameras; must outlive this. Null: they take no pictures
  Environment(World world, Fleet fleet, const EnvironmentOptions& options, ImageSource* images = nullptr);
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
  /// Asks, with the next step, whether a robot has won. The same about threads.
  void checkWin(std::size_t robot);

  void step();

  /// @name A step in parts
  /// For whoever shares a step out among processes that each hold a replica of this environment: step() is begin(),
  /// clip(), judge(), move(), sense(), finish(). The work of clip(), judge() and sense() is done range by range, here
  /// or elsewhere, in any order: what a replica has worked out is read there and put here, and is the same, bit for
  /// bit. Each must be done, or put, for all robots before the next part. A replica needs no finish().
  ///@{
  void begin();                             ///< takes the commands
  void clip(RobotRange range);              ///< move rule (a)
  double clipped(std::size_t robot) const;  ///< the part of its way that it can go, [0, 1]
  void putClipped(std::size_t robot, double fraction);
  void judge(RobotRange range);  ///< move rule (b)
  bool stays(std::size_t robot) const;
  void putStays(std::size_t robot, bool stays);
  void move();
  void sense(RobotRange range);  ///< with all sensors that need not stay home (Sensor::staysHome())
  /// For a sensor that need not stay home: what it measured, to be read or put.
  Measurement& measurement(std::size_t robot, std::size_t slot);
  void finish();  ///< delivers messages; the remaining sensors sense; decides who has won

  /// What the robot will be told in the next step: its last command, but for one that has been halted since.
  Command nextCommand(std::size_t robot) const;
  std::span<const Command> commands() const;  ///< of all robots; after a step, those that it was taken with
  Moment moment() const;                      ///< between steps
  /// Goes on from there. @pre `moment` is of an environment with the same world, fleet and options.
  void resume(const Moment& moment);
  ///@}

  /// Whether every robot has halted or found what it looked for.
  bool allHalted() const;
  /// Hash over all states and readings of all steps so far.
  std::string digest() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
