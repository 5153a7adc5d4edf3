#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/sim_time.h"
#include "dynamics/movable_body.h"
#include "environment/message_router.h"
#include "environment/model.h"
#include "environment/robot_range.h"
#include "environment/run_digest.h"
#include "hardware/command.h"
#include "hardware/readings.h"
#include "robots/drive_kinematics.h"
#include "sensors/sensor.h"
#include "world/changed_objects.h"
#include "world/intervention.h"
#include "world/robot_additions.h"

namespace robosim {

/// A robot, and the step at whose end something became true of it.
struct RobotAtStep {
  std::size_t robot = 0;
  std::uint64_t step = 0;
  bool operator==(const RobotAtStep&) const = default;
};

/// An end of a run by an intervention.
struct RunEnd {
  std::string outcome, text;  ///< EndRun
  std::uint64_t step = 0;     ///< after which it was
  bool operator==(const RunEnd&) const = default;
};

/// An intervention of Environment::apply().
struct AppliedIntervention {
  std::uint64_t step = 0;  ///< the first step in which it has an effect: it was applied directly before it
  Intervention intervention;
  bool operator==(const AppliedIntervention&) const = default;
};

/// All that changes during a run, between two steps. It is complete: a Model and a copy of a State, with the same
/// commands afterwards, continue the run bit for bit, with the same outcome. Nothing else remembers what has happened
/// in a run: handles of robots and summaries read the commands and the outcome from here. Random numbers need no state,
/// because they depend on the step only (base/random.h), and so do the states of radio channels (radio_channel.h);
/// sensors with memory (odometry, battery) keep it in their readings. Arrays are indexed by robot, in the world's
/// order.
struct State {
  SimTime time;
  std::uint64_t seed = 1;  ///< of noise and lost messages: Model::seed unless Environment::restart() was given another
  std::vector<mrpt::math::TPose2D> world_from_robot;
  std::vector<double> speed_mps;  ///< of the last step, after acceleration limits
  std::vector<double> turn_radps;
  std::vector<DriveState> drives;  ///< empty if all robots have a differential drive
  std::vector<Motion> last_motion;
  std::vector<double> driven_m;       ///< distance driven since the start
  std::vector<std::uint8_t> stalled;  ///< the last move was clipped or refused
  std::vector<Activity> activity;
  std::vector<float> laser_pan_rad;
  std::vector<Command> commands;           ///< the last ones; after a step, those used in it; finite
  std::vector<Rare<Outbox>> outboxes;      ///< messages for the next step
  std::vector<std::uint8_t> win_requests;  ///< 1 for a robot that requests CheckWin with the next step
  std::vector<Readings> readings;
  std::vector<ClosedGripper> closed_grippers;  ///< in ascending order of robots
  std::optional<RobotAtStep> found;  ///< the first robot of Activity::found; of several, the first in the world's order
  std::optional<RobotAtStep> won;    ///< the robot that has won
  std::optional<std::uint64_t> all_halted_step;  ///< the first at whose end haveAllHalted()
  /// @name Interventions (Environment::apply())
  ///@{
  ChangedObjects objects;                      ///< instead of World::objects
  std::vector<ObjectSpeed> object_speeds;      ///< of the movable objects, in their order
  std::optional<Communication> communication;  ///< instead of World::communication
  std::optional<RunEnd> ended;
  RobotAdditions additions;                 ///< the last robots of the arrays: those of the Model
  std::uint64_t interventions_applied = 0;  ///< so far
  /// Those of the last step and those since, in the order in which they were applied.
  std::vector<AppliedIntervention> interventions;
  ///@}
  std::uint64_t stalls = 0;                         ///< number of robot-steps so far that were clipped or refused
  std::uint64_t messages_delivered = 0;             ///< a broadcast counts for each receiver
  std::uint64_t messages_dropped = 0;               ///< beyond a robot's limits (InboxLimit, kMaxMessagesSent), so far
  MessageLosses messages_lost;                      ///< so far
  std::vector<MessageInFlight> messages_in_flight;  ///< delayed ones, ordered by due_step, then by sender
  /// Of all steps so far; nullopt: none is computed, which saves its cost in each step. restore() keeps that choice.
  std::optional<RunDigest> digest;

  bool isAbsent(std::size_t robot) const { return activity[robot] == Activity::absent; }
  /// Index of the robot that has won.
  std::optional<std::size_t> winner() const { return won ? std::optional(won->robot) : std::nullopt; }
  /// Whether every robot has halted or found the gold. An absent robot may still come.
  bool haveAllHalted() const;
  bool operator==(const State&) const = default;
};

/// Number of messages that robots have sent so far, including those that wait in an outbox or are in flight. A
/// broadcast counts once for each receiver, unless its sender's limit has dropped it.
std::uint64_t messagesSent(const State&);

/// State before the first measurement: robots at rest at their starts, blank readings, a digest of no steps.
State initialState(const Model&);
/// The same of a process that needs the readings of some robots only: those of the others have no measurements.
State initialState(const Model&, RobotRange with_readings);

/// Of a robot that has not measured yet.
std::vector<Measurement> blankMeasurements(const RobotModel&);

/// Extends the state by the robot that is the last of a model, at its start, active and at rest. It has not measured.
/// @pre the state has the model's other robots
void addLastRobot(State& state, const Model& model);

/// Makes a robot one that has neither moved nor measured.
void resetRobot(State& state, std::size_t robot, Activity activity, const RobotModel& model);

/// @throws std::invalid_argument unless the states have the same time step, number of robots, and kinds and sizes of
/// measurements, as all states of a model do
void requireSameShape(const State& saved, const State& own);

}  // namespace robosim
