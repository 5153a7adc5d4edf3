#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/digest.h"
#include "base/parallel_executor.h"
#include "base/sim_time.h"
#include "environment/model.h"
#include "environment/robot_groups.h"
#include "environment/robot_range.h"
#include "environment/state.h"
#include "geometry/scene.h"
#include "hardware/command.h"
#include "hardware/readings.h"
#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

struct EnvironmentOptions {
  std::uint64_t seed = 1;
  double period_s = 0.1;                 ///< length of a time step, (0, 1]
  int threads = 1;                       ///< does not affect the results
  std::optional<RobotShare> share = {};  ///< of this process when several share a run; nullopt: all robots
};

class StepPhases;

/// Checks a robot that an intervention adds, for what the environment does not know, such as its controller.
/// @return what is wrong, and how to fix it; empty if nothing is
using RobotCheck = std::function<std::string(const FleetRobot&)>;

/// The source of pictures of a run that continues with another model, whose cameras see its robots; null: none.
using ImagesOf = std::function<ImageSource*(const Model&)>;

/// Maximum number of robots that are added to a run, each with a Model of its own.
constexpr std::size_t kAddedRobotsMax = 1000;

/// Advances the State of a Model by time steps. It uses no socket, wall clock or global: the same model and commands
/// give the same run, bit for bit, for any number of threads. A copy of the state saves the run; restore() continues
/// from it, and so does another environment of the same model.
///
/// A time step:
///  0. applies the changes of World::timeline that are due;
///  1. takes each robot's last command;
///  2. authorises and executes the moves. The rule is order-independent: (a) each robot's path is clipped at the first
///     contact with anything stationary, with the surface's edge, and with the position at which every other robot
///     *started* the step; (b) two robots whose clipped paths would still collide both stay where they started (they
///     may turn). Then no two bodies overlap. A robot that was clipped or stays is `stalled`;
///  3. delivers the robot messages sent since the last step: by sender (in the world's order), then in the order sent;
///  4. updates all sensors from one frozen scene; every robot writes only to its own slots;
///  5. decides whether a robot that has called checkWin() is near enough to the gold: then it has won, all robots'
///     readings name it as the winner, and all robots halt (referee.h);
///  6. the state remains constant for readers (recorder, viewer, server) until the next step.
class Environment {
 public:
  /// Places every robot at its start and updates the sensors once, as step 0.
  /// @param images renders the robots' camera pictures; must outlive this object. Null: cameras take no pictures
  Environment(World world, Fleet fleet, const EnvironmentOptions& options, ImageSource* images = nullptr);
  /// Continues from a state of the model. Environments of one model share it.
  /// @param threads, images as above
  /// @throws std::invalid_argument for a state of another world or time step
  Environment(std::shared_ptr<const Model> model, State state, int threads = 1, ImageSource* images = nullptr);
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  /// The present one: when a robot is added, another follows it, and when a state with other added robots is restored.
  /// All of them remain valid as long as the environment, and have the same world. The indices of robots do not change.
  const std::shared_ptr<const Model>& model() const;
  const World& world() const { return model()->world; }
  const Fleet& fleet() const { return model()->fleet; }
  std::size_t robotCount() const { return fleet().robots.size(); }
  const State& state() const;
  SimTime time() const { return state().time; }

  /// Replaces the state between two steps.
  /// @pre a state of this model or of one with other added robots, from any environment or another process
  /// @throws std::invalid_argument for a state of another world or time step
  /// @throws ConfigError when the type of an added robot cannot be read
  void restore(const State& state);
  /// Begins another run of the model between two steps, without building or allocating anything: restores a state
  /// before the first measurement, and updates the sensors once, as step 0. Equal to a new environment that starts at
  /// the state's poses with its seed.
  /// @param start initialState() of the model, with any seed, and any poses at which the robots touch nothing
  /// @throws std::invalid_argument for a state of another world or time step
  void restart(const State& start);

  /// Sets a robot's command; 0 replaces values that are not finite. May be called for different robots from different
  /// threads, between steps.
  void setCommand(std::size_t robot, const Command&);
  /// Queues a message for the next step. Thread-safe like setCommand().
  /// @throws std::invalid_argument for an unknown receiver or a text that is too long
  void send(std::size_t from, const std::string& to, const std::string& text);
  /// The same for one message to every other robot.
  void broadcast(std::size_t from, const std::string& text);
  /// Makes a robot receive a message in the next step, in its place among those of other senders, whatever the radio
  /// and the sender's limits: a message whose delivery another run has decided, such as a recorded one. Not
  /// thread-safe. @throws std::invalid_argument for a text that is too long
  void receive(std::size_t to, std::size_t from, const std::string& text);
  /// Names of all robots in the world's order.
  const std::vector<std::string>& robotNames() const;
  /// Makes the next step decide whether a robot has won. Thread-safe like setCommand().
  void checkWin(std::size_t robot);
  /// Counts messages that a robot's process has not sent because of kMaxMessagesSent.
  void countDroppedMessages(std::uint64_t messages);

  /// Changes the run from outside, between two steps; the next step is the first with the change. The readings are
  /// those of the last step. The change is part of the run: of State::interventions, which recordings contain, and of
  /// the digest. Not thread-safe.
  /// @return what is wrong, and how to fix it, without a change; empty when it is applied
  [[nodiscard]] std::string apply(const Intervention& intervention);
  /// The same for one that another environment of this run has applied, in the same state: it is not checked.
  void applyAgain(const Intervention& intervention);
  /// Also checks each robot before it is added by apply(). Null: no check.
  void setRobotCheck(RobotCheck check);
  /// Called whenever the model is another. Null: the images remain, whose source must then know all robots.
  void setImagesOf(ImagesOf images_of);
  /// The objects at present: those of the world, as interventions have changed them. Valid until the next change.
  const std::vector<WorldObject>& objects() const { return state().objects.orThose(world().objects); }
  /// A copy of the world with its present objects and added robots.
  World presentWorld() const;
  /// Limits and errors of the radio at present.
  const Communication& communication() const;

  /// Puts an absent robot at its start, between two steps: it becomes active, at rest and with blank readings.
  /// Recordings contain it by its readings.
  /// @return false, without a change, if the robot is not absent, or would overlap something
  bool enter(std::size_t robot);
  /// Takes robots out of the world between two steps (Activity::absent): nothing collides with them or senses them,
  /// their commands and messages have no effect, they receive none, and their readings are blank.
  void remove(std::span<const std::size_t> robots);
  void remove(std::size_t robot) { remove({&robot, 1}); }
  /// Number of robots and objects placed, added, changed (also in their activity) or removed so far, by which a replica
  /// detects that its state is no longer valid.
  std::uint64_t poseChanges() const;
  /// Measures, in the present state, with a sensor that is not part of the model. It changes no state.
  /// @param robots in ascending order @param readings by robot: replaces measurement 0, which must be a previous one of
  /// this sensor or Sensor::blank()
  void measure(const Sensor& sensor, std::span<const std::uint32_t> robots, std::span<Readings> readings);

  /// Computes only the sensors of which `is_sensed` is true from now on, also of robots that are added; the readings
  /// of the others stay as they are. Sensors do not affect each other but for a blob finder, which requires its camera.
  /// @throws std::invalid_argument if the state has a digest, which depends on all readings
  void senseOnly(IsSensed is_sensed);

  void step();

  /// The phases of a step and the data between them, for processes that share a run (environment/step_phases.h).
  StepPhases phases();

  bool allHalted() const { return state().haveAllHalted(); }
  /// Hash over all states and readings of all steps so far.
  /// @throws std::invalid_argument when the state has no digest
  std::string digest() const;

 private:
  friend class StepPhases;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
