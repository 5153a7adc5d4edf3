#pragma once
#include <cstdint>
#include <span>

#include "base/digest.h"
#include "environment/environment.h"
#include "environment/robot_range.h"
#include "environment/state.h"
#include "geometry/shapes/path.h"
#include "hardware/command.h"
#include "hardware/readings.h"

namespace robosim {

/// Results of the phases of a step (StepPhases::results()), by robot. They may be exchanged between processes.
struct PhaseResults {
  std::span<Path> paths;          ///< clip(): `end_fraction`, the fraction of its path that the robot can drive
  std::span<std::uint8_t> stays;  ///< judge(): 1 for a robot that stays where it started
  std::span<Readings> readings;   ///< sense(): the measurements of sensors without Sensor::sensesInHostProcess()
  RunDigest* digest;              ///< conclude(): chunks of the digested robots; null if none is computed
};

/// What controllers have requested since the last step (StepPhases::orders()), by robot. Processes that share a run
/// exchange it before begin().
struct StepOrders {
  std::span<Command> commands;
  std::span<Rare<Outbox>> outboxes;
  std::span<std::uint8_t> may_send;  ///< 1 for a robot whose outbox may have messages
  std::span<std::uint8_t> win_requests;
  std::span<Activity> activity;  ///< of the last step; set for robots that are not known and change it
};

/// What determines where robots are and drive next, in addition to StepOrders (StepPhases::motion()), by robot.
struct MotionState {
  std::span<mrpt::math::TPose2D> world_from_robot;
  std::span<double> speed_mps, turn_radps;
  std::span<DriveState> drives;  ///< empty if all robots have a differential drive
  std::span<Motion> last_motion;
  std::span<double> driven_m;
  std::span<std::uint8_t> stalled;
  std::span<float> laser_pan_rad;
  std::uint64_t& stalls;  ///< State::stalls
};

/// A time step in parts, for distributing it over processes that each hold a replica of the environment.
/// Environment::step() is begin(), clip(), judge(), move(), senseFully(), conclude(); the last two are equal to
/// sense(), finish(). clip(), judge() and sense() work on ranges of robots, locally or in replicas, in any order; their
/// results() are copied from a replica to here, and are bit-identical. Each phase must be complete for all robots
/// before the next begins. A replica needs no finish(). A reference to an environment, which must outlive it.
class StepPhases {
 public:
  /// What controllers have requested so far for the next step.
  StepOrders orders();

  void begin();                  ///< takes the commands and empties the inboxes
  void clip(RobotRange range);   ///< move rule (a)
  void judge(RobotRange range);  ///< move rule (b)
  void move();
  void sense(RobotRange range);  ///< updates the sensors without Sensor::sensesInHostProcess()
  void finish();                 ///< delivers messages, updates the remaining sensors, and decides the winner
  PhaseResults results();        ///< of the phases so far in this step

  /// @name The end of a step, for processes that have the readings of some robots only
  /// Instead of sense() and finish(): senseFully() for all robots, in any processes; their measurements are copied to
  /// the processes that need them; conclude() in every process. The state, except the readings, remains the same in
  /// all.
  ///@{
  void senseFully(RobotRange range);  ///< updates all sensors of robots whose readings are kept
  void conclude();                    ///< finish() without sensors
  /// Changes RobotShare::kept: the readings of other robots have no measurements. New ones are blank, and the caller
  /// sets them. Environment::restore() and restart() require those of all robots.
  void keepReadings(RobotRange range);
  /// Changes RobotShare::digested after an intervention has added robots: a range with the robots so far.
  void digest(RobotRange range);
  ///@}

  /// @name The robots that a process knows, for one that shares a run with others
  ///@{
  /// From this step on, only these robots are moved, indexed and sensed here; the state of the others becomes invalid,
  /// except their activity, messages and CheckWin requests. Before, the caller sets orders() and motion() of robots
  /// that were not known. clip(), judge() and senseFully() are then called for robots near which all others are known
  /// (Sensor::robotReach()), and conclude() requires the poses of robots that request CheckWin.
  /// @param known in ascending order; contains RobotShare::kept. All: as in the beginning
  /// @param counted known robots whose stalls are added to State::stalls here
  void limitTo(std::span<const std::uint32_t> known, RobotRange counted);
  MotionState motion();
  ///@}

 private:
  friend class Environment;
  explicit StepPhases(Environment::Impl& environment) : impl_(&environment) {}

  Environment::Impl* impl_;
};

}  // namespace robosim
