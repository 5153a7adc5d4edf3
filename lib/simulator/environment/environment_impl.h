#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include "dynamics/object_mover.h"
#include "environment/environment.h"
#include "environment/known_robots.h"
#include "environment/message_router.h"
#include "environment/move_authorisation.h"
#include "environment/placed_bodies.h"
#include "environment/referee.h"
#include "environment/repeated_values.h"
#include "environment/robot_groups.h"
#include "environment/run_digest.h"
#include "geometry/shapes/chord_batch.h"
#include "hardware/led_color.h"
#include "robots/drive_kinematics.h"

namespace robosim {

/// The state of an environment and the phases of its step. Of Environment and StepPhases only.
struct Environment::Impl {
  /// Selects sensors by Sensor::sensesInHostProcess().
  enum class SensorGroup { all, anywhere, in_host_process };

  /// A property of each robot. In an array of its own, because to look it up in the fleet would cost a cache miss or
  /// more.
  template <typename Property>
  static auto ofRobots(const Fleet& fleet, const Property& property) {
    std::vector<std::decay_t<decltype(property(fleet.robots.front()))>> values;
    values.reserve(fleet.robots.size());
    for (const auto& robot : fleet.robots) values.push_back(property(robot));
    return values;
  }

  static Mover moverOf(const FleetRobot& robot) { return {robot.info.radius_m, robot.body().heights()}; }
  static PushingDisc pushingDiscOf(const FleetRobot& robot) {
    return {robot.info.radius_m, robot.body().heights(), robot.model->push_max_n};
  }
  static MotionLimits limitsOf(const FleetRobot& robot) { return robot.info.type->limits; }
  /// By robot; empty if all robots have a differential drive.
  static std::vector<Drive> drivesOf(const Fleet& fleet) {
    if (!hasOtherDrives(fleet)) return {};
    return ofRobots(fleet, [](const FleetRobot& robot) { return robot.info.type->drive; });
  }
  static double antennaOf(const FleetRobot& robot) { return robot.body().heights().z_max_m; }
  /// Memory for the motion of the step before the last; empty if no sensor uses it.
  static std::vector<Motion> formerMotionOf(const Fleet& fleet) {
    const auto uses_it = [](const auto& sensor) { return sensor->usesFormerMotion(); };
    const bool is_used = std::any_of(fleet.robots.begin(), fleet.robots.end(), [&](const FleetRobot& robot) {
      return std::any_of(robot.model->sensors.begin(), robot.model->sensors.end(), uses_it);
    });
    return std::vector<Motion>(is_used ? fleet.robots.size() : 0);
  }
  static double finiteOrZero(double value) { return std::isfinite(value) ? value : 0; }

  std::shared_ptr<const Model> model;
  std::vector<std::shared_ptr<const Model>> models;  ///< all of the run so far, to which readers may refer
  /// Arrays of former states with another number of robots, to which readers may refer (arrays of Python).
  struct FormerArrays {
    std::vector<mrpt::math::TPose2D> world_from_robot;
    std::vector<Command> commands;
    std::vector<std::uint8_t> stalled;
  };
  std::vector<FormerArrays> former_arrays;
  RobotCheck robot_check;
  ImagesOf images_of;
  bool is_shared;  ///< with other processes
  ImageSource* images;
  ParallelExecutor workers;
  State state;
  PlacedBodies bodies;
  Scene& scene;  ///< of the bodies
  MoveAuthorisation move_authorisation;
  ObjectMover object_mover;
  std::vector<ObjectMotion> motions;  ///< of the movable objects: of State::objects and State::object_speeds
  std::vector<HeldObject> held;       ///< of State::closed_grippers
  std::vector<std::uint32_t> robots_with_gripper;
  std::optional<Referee> referee;  ///< of `referee_objects`
  ChangedObjects referee_objects;
  MessageRouter message_router;
  IsSensed is_sensed;  ///< null: all sensors are computed
  RobotGroups robot_groups;
  RepeatedValues<MotionLimits> limits;  ///< by robot
  std::vector<Drive> drives;            ///< drivesOf() the fleet
  KnownRobots known;
  RobotRange counted;  ///< known robots whose stalls are counted
  std::vector<Path> paths;
  std::vector<Motion> former_motion;   ///< Snapshot::former_motion
  RepeatedValues<double> antenna_z_m;  ///< by robot
  std::uint64_t pose_changes = 0;
  bool has_absent_robots = false;
  bool may_have_messages = true;       ///< in any inbox; false: only in those of MessageRouter::receivers()
  std::vector<std::uint8_t> may_send;  ///< MessageRouter::Robots::may_send
  RobotShare share;

  /// @param the_share of a process that shares the run; nullopt: all robots
  Impl(std::shared_ptr<const Model> the_model, State the_state, int threads, ImageSource* the_images,
       const std::optional<RobotShare>& the_share = {})
      : model(std::move(the_model)),
        models{model},
        is_shared(the_share.has_value()),
        images(the_images),
        workers(threads),
        state(std::move(the_state)),
        bodies(*model, state.objects.orThose(model->world.objects)),
        scene(bodies.scene()),
        move_authorisation(ofRobots(fleet(), moverOf), model->world.bounds),
        object_mover(moverOfObjects()),
        message_router(fleet().robots, model->world.communication),
        robot_groups(fleet(), model->period_s),
        limits(ofRobots(fleet(), limitsOf)),
        drives(drivesOf(fleet())),
        known(fleet().robots.size()),
        counted(everyRobot()),
        paths(fleet().robots.size()),
        former_motion(formerMotionOf(fleet())),
        antenna_z_m(ofRobots(fleet(), antennaOf)),
        share(the_share.value_or(RobotShare{everyRobot(), everyRobot()})) {
    noteGrippers();
    noteState();
    placeBodies();
  }

  const Fleet& fleet() const { return model->fleet; }
  void noteGrippers() {
    robots_with_gripper.clear();
    for (std::uint32_t i = 0; i < fleet().robots.size(); ++i) {
      if (fleet().robots[i].model->gripper) robots_with_gripper.push_back(i);
    }
  }

  /// @name Robots that are added (added_robots.cpp)
  ///@{
  /// A model of this run in which these robots have been added. @throws ConfigError
  std::shared_ptr<const Model> modelWith(const RobotAdditions& additions) const;
  /// Continues with another model of this run, of the state's robots. noteState() and placeBodies() must follow.
  void useModel(std::shared_ptr<const Model> other);
  /// Replaces the state by one with another number of robots.
  void replaceState(State other);
  /// Adds the robot that is the last of another model.
  void addRobot(std::shared_ptr<const Model> larger);
  /// Restores a state in which other robots have been added.
  void restoreWithOtherRobots(const State& saved);
  ///@}

  /// After the state was replaced.
  void noteState() {
    noteAbsentRobots();
    noteMotions();
    message_router.setCommunication(state.communication.value_or(model->world.communication));
    may_have_messages = true;
    may_send.resize(state.outboxes.size());
    std::transform(state.outboxes.begin(), state.outboxes.end(), may_send.begin(),
                   [](const Rare<Outbox>& outbox) -> std::uint8_t { return outbox ? 1 : 0; });
  }

  void noteAbsentRobots() {
    has_absent_robots =
        std::find(state.activity.begin(), state.activity.end(), Activity::absent) != state.activity.end();
  }

  const std::vector<WorldObject>& objects() const { return state.objects.orThose(model->world.objects); }

  /// @name Objects that move (moving_objects.cpp)
  ///@{
  /// After State::objects or State::object_speeds were replaced.
  void noteMotions();
  ObjectMover moverOfObjects() const;
  /// After State::objects were replaced by a list of other objects.
  void useObjects();
  /// Moves objects, and stops robots that they block, after the authorisation of moves.
  void moveObjects();
  ///@}

  /// @name Grippers (gripping.cpp)
  ///@{
  /// After State::closed_grippers or the motions were replaced. @throws std::invalid_argument for an object that there
  /// is not
  void noteHeld();
  /// Opens the grippers whose commands say so. What they held is at rest then.
  void openGrippers();
  /// Closes the grippers whose commands say so, on what is between their paddles.
  void closeGrippers();
  /// Moves what robots hold to the ends of their paths. @return whether anything has moved
  bool carry();
  /// What an intervention takes away is held no longer.
  void letGoOf(const std::string& object);
  void letGo(std::size_t robot);
  std::optional<HeldObject> objectBetweenPaddles(std::uint32_t robot) const;
  ///@}

  /// @name Objects that change
  ///@{
  /// @param changed name of the object that is another or elsewhere: it is at rest then
  void setObjects(std::vector<WorldObject> objects, const std::string& changed);
  /// Speeds of a list of objects: those that objects of the same names have now.
  std::vector<ObjectSpeed> speedsOf(const std::vector<WorldObject>& objects_then, const std::string& at_rest) const;
  ///@}

  void placeBodies() { bodies.place(state, motions, known, share.kept, workers); }

  void clearInboxes() {
    const auto clear = [&](std::size_t i) { state.readings[i].inbox.clear(); };
    if (std::exchange(may_have_messages, false)) {
      workers.forEach(state.readings.size(), kRobotChunk, clear);
      return;
    }
    const std::vector<std::uint32_t>& receivers = message_router.receivers();
    workers.forEach(receivers.size(), kRobotChunk, [&](std::size_t k) { clear(receivers[k]); });
  }

  void takeCommands() {
    if (!state.closed_grippers.empty()) openGrippers();
    known.forEach(workers, kRobotChunk, [&](std::size_t i) {
      Command& command = state.commands[i];
      if (state.activity[i] == Activity::active && command.activity != Activity::absent) {
        state.activity[i] = command.activity;
      }
      command.activity = state.activity[i];
      state.laser_pan_rad[i] =
          std::clamp(command.laser_pan_rad, -static_cast<float>(M_PI_2), static_cast<float>(M_PI_2));
      if (hasOtherDrive(i)) return driveOtherwise(i);
      const DriveSpeeds speeds =
          reachableSpeeds({state.speed_mps[i], state.turn_radps[i]}, command, limits[i], model->period_s);
      state.speed_mps[i] = speeds.speed_mps;
      state.turn_radps[i] = speeds.turn_radps;
      paths[i] = pathOf(state.world_from_robot[i], speeds, model->period_s);
    });
    for (const auto& object : held) paths[object.robot].turn_stops = true;
  }

  bool hasOtherDrive(std::size_t robot) const {
    return !drives.empty() && drives[robot].kind != DriveKind::differential;
  }
  /// @name Robots whose drive is not differential (other_drives.cpp)
  ///@{
  DriveMotion motionOf(std::size_t robot) const;
  void setMotion(std::size_t robot, const DriveMotion& motion);
  /// takeCommands() of a robot.
  void driveOtherwise(std::size_t robot);
  /// move() of a robot that has moved along its path.
  void noteOtherMotion(std::size_t robot);
  ///@}

  void move() {
    move_authorisation.conclude(workers, known, paths, state.stalled);
    if (!motions.empty()) moveObjects();
    known.forChunks(workers, kRobotChunk, [&](const auto& order, std::size_t begin, std::size_t end) {
      movePoses(order, begin, end);
      for (std::size_t k = begin; k < end; ++k) noteMotion(order[k]);
    });
    for (const auto& object : held) {
      if (state.stalled[object.robot]) state.turn_radps[object.robot] = 0;
    }
    const auto stalls_of = [&](std::size_t begin, std::size_t end) {
      std::uint64_t stalls = 0;
      for (std::size_t i = counted.begin + begin; i < counted.begin + end; ++i) stalls += state.stalled[i];
      return stalls;
    };
    state.stalls += workers.reduce(counted.end - counted.begin, std::uint64_t{0}, stalls_of, std::plus<>());
    placeBodies();
    if (!robots_with_gripper.empty()) closeGrippers();
  }

  /// Moves robots to the ends of their paths.
  template <typename Order>
  void movePoses(const Order& order, std::size_t begin, std::size_t end) {
    static_assert(kRobotChunk <= ChordBatch::kCapacity);
    std::array<const Path*, kRobotChunk> moved;
    std::array<mrpt::math::TPose2D*, kRobotChunk> poses;
    std::size_t count = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const Path& path = paths[order[k]];
      moved[count] = &path;
      poses[count] = &state.world_from_robot[order[k]];
      count += path.length_m != 0 || path.turn_rad != 0 ? 1 : 0;
    }
    computeEndPoses({moved.data(), count}, {poses.data(), count});
  }

  /// After a robot has moved along its path.
  void noteMotion(std::size_t i) {
    const Path& path = paths[i];
    if (!former_motion.empty()) former_motion[i] = state.last_motion[i];
    state.last_motion[i] = {path.clippedLength(), path.clippedTurn()};
    state.driven_m[i] += std::abs(path.clippedLength());
    if (state.stalled[i]) state.speed_mps[i] = 0;  // blocked: starts from rest in the next step
    if (hasOtherDrive(i)) noteOtherMotion(i);
  }

  RobotRange everyRobot() const { return {0, fleet().robots.size()}; }

  /// @param kept memory for the result
  std::span<const std::uint32_t> presentOf(std::span<const std::uint32_t> robots,
                                           std::vector<std::uint32_t>& kept) const {
    if (!has_absent_robots) return robots;
    std::copy_if(robots.begin(), robots.end(), std::back_inserter(kept),
                 [&](auto robot) { return !state.isAbsent(robot); });
    return kept;
  }

  Snapshot snapshot() const {
    Snapshot now = bodies.snapshot(state, paths, images);
    now.former_motion = former_motion;
    return now;
  }

  /// Of `all`, those that may be computed anywhere come first, as in two calls. No sensor reads messages, which may
  /// therefore be delivered between the two or afterwards.
  void sense(RobotRange range, SensorGroup which) {
    const bool has_slots = which != SensorGroup::in_host_process && robot_groups.have_slots;
    const bool has_host_slots = which != SensorGroup::anywhere && robot_groups.have_host_slots;
    if (has_slots || has_host_slots) {
      const Snapshot now = snapshot();
      forPresent(range, which, [&](const RobotGroup& group, std::span<const std::uint32_t> robots) {
        const auto sense = [&](std::size_t slot) {
          group.model->sensors[slot]->sense(now, robots, slot, state.readings);
        };
        if (has_slots) std::for_each(group.slots.begin(), group.slots.end(), sense);
        if (has_host_slots) std::for_each(group.host_slots.begin(), group.host_slots.end(), sense);
      });
    } else if (which != SensorGroup::in_host_process) {  // the neighbours are also those of the next step's paths
      forPresent(range, which, [](const RobotGroup&, std::span<const std::uint32_t>) {});
    }
  }
  /// Calls use(group, robots) for the robots of a range that are present, in pieces, after updating their neighbours.
  /// @param which leaves out robots without such sensors in the host's process
  template <typename Use>
  void forPresent(RobotRange range, SensorGroup which, const Use& use) {
    for (const RobotGroup& group : robot_groups.groups) {
      if (which == SensorGroup::in_host_process && group.host_slots.empty()) continue;
      const auto of_group = group.within(range);
      workers.forChunks(of_group.size(), kRobotChunk, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> kept;
        const auto robots = presentOf(of_group.subspan(begin, end - begin), kept);
        for (const auto i : robots) scene.updateNeighbours(i, group.reach_m);
        use(group, robots);
      });
    }
  }

  void measure(const Sensor& sensor, std::span<const std::uint32_t> robots, std::span<Readings> readings) {
    const Snapshot now = snapshot();
    const double sensor_reach_m = reachOf(sensor) + kContactGap_m;
    workers.forChunks(robots.size(), kRobotChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto robot = robots[i];
        // The reach of the model too, so that its own sensors find the same neighbours in the next step.
        scene.updateNeighbours(robot, std::max(sensor_reach_m, robot_groups.groupOf(robot).reach_m));
      }
      sensor.sense(now, robots.subspan(begin, end - begin), 0, readings);
    });
  }

  /// @name Interventions (interventions.cpp)
  ///@{
  struct ApplyChange;
  /// Applies a change. @return what is wrong, and how to fix it; empty when it is applied
  std::string apply(const Intervention& intervention, bool is_checked);
  /// Applies the changes of the world file that are due before the next step. One that is refused is logged.
  void applyTimeline();
  ///@}

  bool enter(std::size_t robot) {
    if (!state.isAbsent(robot)) return false;
    const auto& start = fleet().robots[robot].world_from_start;
    if (!isFreeFor(robot, start)) return false;
    moveRobot(robot, start);
    return true;
  }

  bool isFreeFor(std::size_t robot, const mrpt::math::TPose2D& pose) const {
    const Solid disc = bodies.discOf(robot, {pose.x, pose.y});
    return model->world.bounds.covers(boundsOf(disc.outline)) &&
           bodies.overlapped(disc, scene.movingBody(robot)) == kNoBody;
  }

  void moveRobot(std::size_t robot, const mrpt::math::TPose2D& world_from_robot) {
    state.world_from_robot[robot] = world_from_robot;
    state.world_from_robot[robot].phi = std::remainder(world_from_robot.phi, 2 * M_PI);
    letGo(robot);
    if (state.isAbsent(robot)) resetRobot(state, robot, Activity::active, *fleet().robots[robot].model);
    ++pose_changes;
    noteAbsentRobots();
    placeBodies();
  }

  void remove(std::span<const std::size_t> robots) {
    const auto changes_before = pose_changes;
    for (const std::size_t robot : robots) {
      if (state.isAbsent(robot)) continue;
      letGo(robot);
      resetRobot(state, robot, Activity::absent, *fleet().robots[robot].model);
      ++pose_changes;
    }
    if (pose_changes == changes_before) return;
    noteAbsentRobots();
    placeBodies();
  }

  void begin() {
    if (!model->world.timeline.empty()) applyTimeline();
    ++state.time.step;
    if (!state.interventions.empty()) {
      std::erase_if(state.interventions, [&](const auto& applied) { return applied.step < state.time.step; });
    }
    clearInboxes();
    takeCommands();
    move_authorisation.begin(workers, known, paths, held);
  }

  void deliverMessages() {
    const auto counts = message_router.deliver(state.seed, state.time,
                                               {scene, state.world_from_robot, antenna_z_m, state.activity, may_send},
                                               state.outboxes, state.messages_in_flight, state.readings);
    state.messages_delivered += counts.delivered;
    state.messages_dropped += counts.dropped;
    state.messages_lost += counts.lost;
  }

  /// The phase after all sensing.
  void finish() {
    deliverMessages();
    sense(everyRobot(), SensorGroup::in_host_process);
    conclude();
  }

  /// The phase after all sensing and the delivery of messages.
  void conclude() {
    workers.forEach(share.kept.end - share.kept.begin, kRobotChunk, [&](std::size_t k) {
      const std::size_t i = share.kept.begin + k;
      Readings& readings = state.readings[i];
      readings.time = state.time;
      readings.stalled = state.stalled[i] != 0;
      readings.laser_pan_rad = state.laser_pan_rad[i];
      readings.is_too_far = false;
    });
    if (anyFlag(state.win_requests)) {
      if (!state.won) decideWinner();
      std::fill(state.win_requests.begin(), state.win_requests.end(), 0);
    }
    noteOutcome();
    if (!state.digest) return;
    state.digest->add(state, workers, share.digested);
    if (!motions.empty()) state.digest->add(motions);
  }

  void noteOutcome() {
    if (!state.found) {
      static_assert(sizeof(Activity) == 1);
      const std::span<const Activity> activity = state.activity;
      const auto found = findByte(std::as_bytes(activity), std::byte{static_cast<std::uint8_t>(Activity::found)});
      if (found < activity.size()) state.found = {found, state.time.step};
    }
    if (!state.all_halted_step && state.haveAllHalted()) state.all_halted_step = state.time.step;
  }

  void keepReadings(RobotRange range) {
    for (std::size_t i = share.kept.begin; i < share.kept.end; ++i) {
      if (!range.contains(i)) state.readings[i].measurements = std::vector<Measurement>();
    }
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!share.kept.contains(i)) state.readings[i].measurements = blankMeasurements(*fleet().robots[i].model);
    }
    share.kept = range;
  }

  /// The referee of the present objects, which is made again only when they have changed.
  const Referee& refereeNow() {
    if (!referee || !referee_objects.isSameList(state.objects)) {
      referee.emplace(objects(), model->world.win_distance_m);
      referee_objects = state.objects;
    }
    return *referee;
  }

  void decideWinner() {
    const auto disc_of = [this](std::size_t robot) {
      const auto& pose = state.world_from_robot[robot];
      return Circle{{pose.x, pose.y}, fleet().robots[robot].info.radius_m};
    };
    const auto winner = refereeNow().decide(state.win_requests, disc_of);
    if (!winner) {
      forFlags(state.win_requests, [&](std::size_t i) {
        if (share.kept.contains(i)) state.readings[i].is_too_far = true;
      });
      return;
    }
    state.won = {*winner, state.time.step};
    for (std::size_t i = 0; i < state.readings.size(); ++i) {
      state.readings[i].winner = fleet().robots[*winner].info.name;
      if (state.activity[i] == Activity::active) {
        state.activity[i] = i == *winner ? Activity::found : Activity::halted;
      }
    }
  }

  void setCommand(std::size_t robot, const Command& command) {
    Command& kept = state.commands[robot];
    kept = command;
    kept.speed_mps = finiteOrZero(command.speed_mps);
    kept.turn_radps = finiteOrZero(command.turn_radps);
    kept.lateral_mps = finiteOrZero(command.lateral_mps);
    if (!std::isfinite(command.laser_pan_rad)) kept.laser_pan_rad = 0;
    kept.led_color &= kLedColorMax;
    if (!command.camera_head->isFinite()) kept.camera_head = {};
  }

  void restore(const State& saved) {
    if (saved.additions != state.additions) return restoreWithOtherRobots(saved);
    requireSameShape(saved, state);
    const bool has_same_objects = saved.objects.isSameList(state.objects);
    state = saved;
    if (!has_same_objects) useObjects();
    noteState();
    placeBodies();
  }

  /// Measures step 0.
  void start() {
    sense(share.kept, SensorGroup::all);
    deliverMessages();
    conclude();
  }

  void restart(const State& start_state) {
    restore(start_state);
    start();
  }
};

}  // namespace robosim
