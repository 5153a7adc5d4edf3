#include "environment/environment.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "environment/authorise.h"
#include "environment/mail.h"
#include "environment/referee.h"
#include "environment/run_digest.h"
#include "robots/differential_drive.h"

namespace robosim {
namespace {

constexpr std::size_t kChunk = 64;

std::vector<Mover> moversOf(const Fleet& fleet) {
  std::vector<Mover> movers;
  movers.reserve(fleet.robots.size());
  for (const auto& robot : fleet.robots) movers.push_back({robot.info.radius_m, robot.body.heights()});
  return movers;
}

std::vector<std::string> namesOf(const Fleet& fleet) {
  std::vector<std::string> names;
  names.reserve(fleet.robots.size());
  for (const auto& robot : fleet.robots) names.push_back(robot.info.name);
  return names;
}

/// Which sensors are to sense: see Sensor::staysHome().
struct SensorChoice {
  bool at_home = false;
  bool elsewhere = false;
};

/// Robots that carry the same sensors.
struct Group {
  const RobotModel* model;
  double reach_m;  ///< how far they look, or drive in a step, from their centres
  std::vector<std::uint32_t> robots;
};

double reachOf(const RobotModel& model, double period_s) {
  double reach_m = model.radius_m + model.limits.speed_max_mps * period_s;
  for (const auto& sensor : model.sensors) {
    const SensorInfo& info = sensor->info();
    for (const auto& beam : info.beams) {
      reach_m = std::max(reach_m, info.range_max_m + std::hypot(beam.robot_from_beam.x, beam.robot_from_beam.y));
    }
  }
  return reach_m + kContactGap_m;
}

std::vector<Group> groupsOf(const Fleet& fleet, double period_s) {
  std::vector<Group> groups;
  std::map<const RobotModel*, std::size_t> group_of;
  for (std::uint32_t i = 0; i < fleet.robots.size(); ++i) {
    const RobotModel* model = fleet.robots[i].model.get();
    const auto [found, is_new] = group_of.emplace(model, groups.size());
    if (is_new) groups.push_back({model, reachOf(*model, period_s), {}});
    groups[found->second].robots.push_back(i);
  }
  return groups;
}

}  // namespace

struct Environment::Impl {
  World world;
  Fleet fleet;
  EnvironmentOptions options;
  ImageSource* images;
  Workers workers;
  Scene scene;
  Authority authority;
  Mail mail;
  Referee referee;
  RunDigest digest;
  std::vector<Group> groups;
  std::vector<Command> commands;
  std::vector<Path> paths;
  std::vector<double> base_z_m;          ///< of each robot's underside
  std::vector<LevelFrame> frames;        ///< where the robots are now
  std::vector<NeighbourList> near;       ///< what stands around the robots
  std::vector<HeatSource> heat_sources;  ///< hot objects, then hot robots
  State state;

  Impl(World the_world, Fleet the_fleet, const EnvironmentOptions& the_options, ImageSource* the_images)
      : world(std::move(the_world)),
        fleet(std::move(the_fleet)),
        options(the_options),
        images(the_images),
        workers(options.threads),
        scene(stationarySolids(world), fleet.robots.size(), world.bounds),
        authority(moversOf(fleet), world.bounds),
        mail(namesOf(fleet), world.communication, options.seed),
        referee(world, fleet.robots.size()),
        digest(fleet.robots.size()),
        groups(groupsOf(fleet, options.period_s)),
        commands(fleet.robots.size()),
        paths(fleet.robots.size()),
        frames(fleet.robots.size()),
        near(fleet.robots.size()) {
    const std::size_t n = fleet.robots.size();
    state.time = {0, options.period_s};
    state.world_from_robot.resize(n);
    state.speed_mps.resize(n);
    state.turn_radps.resize(n);
    state.last_motion.resize(n);
    state.driven_m.resize(n);
    state.stalled.resize(n);
    state.activity.resize(n, Activity::active);
    state.laser_pan_rad.resize(n);
    state.readings.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const FleetRobot& robot = fleet.robots[i];
      state.world_from_robot[i] = robot.world_from_start;
      base_z_m.push_back(robot.body.heights().z_min_m);
      for (const auto& sensor : robot.model->sensors) state.readings[i].measurements.push_back(sensor->blank());
    }
    for (std::size_t i = 0; i < world.objects.size(); ++i) {
      const auto& pose = world.objects[i].body.world_from_body;
      addHeatSource(world.objects[i].body, {pose.x, pose.y}, BodyId(static_cast<std::uint32_t>(i)));
    }
    for (std::size_t i = 0; i < n; ++i) addHeatSource(fleet.robots[i].body, {}, scene.movingBody(i));
    placeBodies();
    sense(everyRobot(), {.elsewhere = true});
    finish();
  }

  void addHeatSource(const Body& body, const mrpt::math::TPoint2D& center, BodyId id) {
    if (body.heat_celsius != 0) heat_sources.push_back({center, body.heat_celsius, id});
  }

  void placeBodies() {
    workers.forEach(fleet.robots.size(), kChunk, [&](std::size_t i) {
      Body body = fleet.robots[i].body;
      body.world_from_body = state.world_from_robot[i];
      frames[i] = LevelFrame(state.world_from_robot[i], base_z_m[i]);
      scene.place(i, body.solid());
    });
    scene.freeze();
    for (auto& source : heat_sources) {
      if (static_cast<std::size_t>(source.body) < scene.stationaryCount()) continue;
      const auto& pose = state.world_from_robot[scene.movingIndex(source.body)];
      source.center = {pose.x, pose.y};
    }
  }

  void takeCommands() {
    workers.forEach(fleet.robots.size(), kChunk, [&](std::size_t i) {
      Command& command = commands[i];
      if (state.activity[i] == Activity::active) state.activity[i] = command.activity;
      command.activity = state.activity[i];
      state.laser_pan_rad[i] =
          std::isfinite(command.laser_pan_rad)
              ? std::clamp(command.laser_pan_rad, -static_cast<float>(M_PI_2), static_cast<float>(M_PI_2))
              : 0;
      const DriveSpeeds speeds = reachableSpeeds({state.speed_mps[i], state.turn_radps[i]}, command,
                                                 fleet.robots[i].info.limits, options.period_s);
      state.speed_mps[i] = speeds.speed_mps;
      state.turn_radps[i] = speeds.turn_radps;
      paths[i] = pathOf(state.world_from_robot[i], speeds, options.period_s);
    });
  }

  void move() {
    authority.conclude(workers, paths, state.stalled);
    workers.forEach(fleet.robots.size(), kChunk, [&](std::size_t i) {
      const Path& path = paths[i];
      if (path.length_m != 0 || path.turn_rad != 0) state.world_from_robot[i] = path.endPose();
      state.last_motion[i] = {path.clippedLength(), path.turn_rad};
      state.driven_m[i] += std::abs(path.clippedLength());
      if (state.stalled[i]) state.speed_mps[i] = 0;  // it stands against something and starts from rest
    });
    state.stalls += static_cast<std::uint64_t>(std::count(state.stalled.begin(), state.stalled.end(), 1));
    placeBodies();
  }

  RobotRange everyRobot() const { return {0, fleet.robots.size()}; }

  /// Those of a group's robots that lie in a range.
  static std::span<const std::uint32_t> within(const Group& group, RobotRange range) {
    const auto begin = std::lower_bound(group.robots.begin(), group.robots.end(), range.begin);
    return {begin, std::lower_bound(begin, group.robots.end(), range.end)};
  }

  /// @param which sensors: those that SensorChoice names
  void sense(RobotRange range, SensorChoice which) {
    const Snapshot now{.scene = scene,
                       .heat_sources = heat_sources,
                       .world_from_robot = state.world_from_robot,
                       .frames = frames,
                       .near = near,
                       .last_motion = state.last_motion,
                       .laser_pan_rad = state.laser_pan_rad,
                       .time = state.time,
                       .seed = options.seed,
                       .images = images};
    for (const auto& group : groups) {
      const auto of_group = within(group, range);
      workers.forChunks(of_group.size(), kChunk, [&](std::size_t begin, std::size_t end) {
        const auto robots = of_group.subspan(begin, end - begin);
        for (const auto i : robots) {
          scene.update(near[i], {state.world_from_robot[i].x, state.world_from_robot[i].y}, group.reach_m);
        }
        for (std::size_t slot = 0; slot < group.model->sensors.size(); ++slot) {
          const Sensor& sensor = *group.model->sensors[slot];
          if (sensor.staysHome() ? which.at_home : which.elsewhere) {
            sensor.sense(now, robots, slot, state.readings);
          }
        }
      });
    }
  }

  void begin() {
    ++state.time.step;
    takeCommands();
    authority.begin(paths);
  }

  /// What is left when all have sensed.
  void finish() {
    state.messages_delivered += mail.deliver(state.time, state.world_from_robot, state.readings);
    sense(everyRobot(), {.at_home = true});
    workers.forEach(fleet.robots.size(), kChunk, [&](std::size_t i) {
      state.readings[i].time = state.time;
      state.readings[i].stalled = state.stalled[i] != 0;
      state.readings[i].laser_pan_rad = state.laser_pan_rad[i];
    });
    if (!state.winner) decideWinner();
    digest.add(state, workers);
  }

  void decideWinner() {
    for (const auto robot : referee.refused()) state.readings[robot].is_too_far = false;
    state.winner = referee.decide([this](std::size_t robot) {
      const auto& pose = state.world_from_robot[robot];
      return Circle{{pose.x, pose.y}, fleet.robots[robot].info.radius_m};
    });
    for (const auto robot : referee.refused()) state.readings[robot].is_too_far = true;
    if (!state.winner) return;
    for (std::size_t i = 0; i < state.readings.size(); ++i) {
      state.readings[i].winner = fleet.robots[*state.winner].info.name;
      if (state.activity[i] == Activity::active) {
        state.activity[i] = i == *state.winner ? Activity::found : Activity::halted;
      }
    }
  }

  void setCommand(std::size_t robot, const Command& command) { commands[robot] = nextCommand(robot, command); }

  /// A robot that has halted has done so for good, whatever it says.
  Command nextCommand(std::size_t robot, Command command) const {
    if (state.activity[robot] != Activity::active) command.activity = state.activity[robot];
    return command;
  }

  void resume(const Moment& moment) {
    state.time.step = moment.step;
    state.world_from_robot = moment.world_from_robot;
    state.speed_mps = moment.speed_mps;
    state.turn_radps = moment.turn_radps;
    state.activity = moment.activity;
    commands = moment.commands;
    placeBodies();
  }
};

Environment::Environment(World world, Fleet fleet, const EnvironmentOptions& options, ImageSource* images)
    : impl_(std::make_unique<Impl>(std::move(world), std::move(fleet), options, images)) {}

Environment::~Environment() = default;

const World& Environment::world() const { return impl_->world; }
const Fleet& Environment::fleet() const { return impl_->fleet; }
std::size_t Environment::robotCount() const { return impl_->fleet.robots.size(); }
const State& Environment::state() const { return impl_->state; }
SimTime Environment::time() const { return impl_->state.time; }

void Environment::setCommand(std::size_t robot, const Command& command) { impl_->setCommand(robot, command); }

void Environment::send(std::size_t from, const std::string& to, const std::string& text) {
  impl_->mail.send(from, to, text);
}

void Environment::checkWin(std::size_t robot) { impl_->referee.ask(robot); }

void Environment::step() {
  const RobotRange every = impl_->everyRobot();
  begin();
  clip(every);
  judge(every);
  move();
  sense(every);
  finish();
}

void Environment::begin() { impl_->begin(); }
void Environment::clip(RobotRange range) {
  impl_->authority.clip(impl_->scene, impl_->near, impl_->workers, range, impl_->paths);
}
void Environment::judge(RobotRange range) { impl_->authority.judge(impl_->scene, impl_->workers, range, impl_->paths); }
void Environment::move() { impl_->move(); }
void Environment::sense(RobotRange range) { impl_->sense(range, {.elsewhere = true}); }
void Environment::finish() { impl_->finish(); }

double Environment::clipped(std::size_t robot) const { return impl_->paths[robot].end_fraction; }
void Environment::putClipped(std::size_t robot, double fraction) {
  impl_->authority.putClipped(robot, fraction, impl_->paths);
}
bool Environment::stays(std::size_t robot) const { return impl_->authority.stays()[robot] != 0; }
void Environment::putStays(std::size_t robot, bool stays) { impl_->authority.stays()[robot] = stays ? 1 : 0; }
Measurement& Environment::measurement(std::size_t robot, std::size_t slot) {
  return impl_->state.readings[robot].measurements[slot];
}

Moment Environment::moment() const {
  const State& now = impl_->state;
  return {now.time.step, now.world_from_robot, now.speed_mps, now.turn_radps, now.activity, impl_->commands};
}
void Environment::resume(const Moment& moment) { impl_->resume(moment); }
Command Environment::nextCommand(std::size_t robot) const { return impl_->nextCommand(robot, impl_->commands[robot]); }
std::span<const Command> Environment::commands() const { return impl_->commands; }

bool Environment::allHalted() const {
  const auto& activity = impl_->state.activity;
  return !activity.empty() &&
         std::none_of(activity.begin(), activity.end(), [](Activity a) { return a == Activity::active; });
}

std::string Environment::digest() const { return impl_->digest.text(); }

}  // namespace robosim
