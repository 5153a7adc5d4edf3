#include "wire/geometry_wire.h"

#include <cmath>
#include <string>
#include <utility>

#include "environment/intervention_bytes.h"
#include "environment/step_phases.h"
#include "net/robot_wire.h"
#include "wire/plausible_echoes.h"

namespace robosim {
namespace {

std::size_t checkedRobot(std::uint32_t robot, RobotRange range) {
  if (robot < range.begin || robot >= range.end) {
    throw WireError("a robot of the number " + std::to_string(robot) + " where those of [" +
                    std::to_string(range.begin) + ", " + std::to_string(range.end) + ") are meant");
  }
  return robot;
}

double checkedFraction(double fraction) {
  if (!(fraction >= 0 && fraction <= 1)) throw WireError("a part of a way that is not in [0, 1]");
  return fraction;
}

double checkedFinite(double value) {
  if (!std::isfinite(value)) throw WireError("a robot's state that is not finite");
  return value;
}

/// Calls visit(robot, measurement, sensor) for each sensor of the robots in `range` that a replica may compute.
template <typename ReadingsSpan, typename Visit>
void forMeasurements(const Fleet& fleet, ReadingsSpan& readings, RobotRange range, const Visit& visit) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const auto& sensors = fleet.robots[i].model->sensors;
    for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
      if (!sensors[slot]->sensesInHostProcess()) visit(i, readings[i].measurements[slot], sensors[slot]->info());
    }
  }
}

}  // namespace

void encode(const State& state, internal::ReplicaState& out) {
  out.Clear();
  out.set_step(state.time.step);
  for (std::size_t i = 0; i < state.commands.size(); ++i) {
    auto& robot = *out.add_robots();
    robot.set_x_m(state.world_from_robot[i].x);
    robot.set_y_m(state.world_from_robot[i].y);
    robot.set_phi_rad(state.world_from_robot[i].phi);
    robot.set_speed_mps(state.speed_mps[i]);
    robot.set_turn_radps(state.turn_radps[i]);
    if (!state.drives.empty()) {
      robot.set_lateral_mps(state.drives[i].lateral_mps);
      robot.set_steering_rad(state.drives[i].steering_rad);
    }
    robot.set_activity(encode(state.activity[i]));
    encode(state.commands[i], *robot.mutable_command());
  }
  StateWriter objects;
  writeObjects(state.objects, objects);
  writeSpeeds(state, objects);
  writeGrippers(state, objects);
  out.set_objects(std::move(objects.bytes));
}

void decodeInto(const internal::ReplicaState& in, State& state) {
  const std::size_t robots = state.commands.size();
  if (static_cast<std::size_t>(in.robots_size()) != robots) throw WireError("a state of another world");
  state.time.step = in.step();
  for (std::size_t i = 0; i < robots; ++i) {
    const auto& robot = in.robots(static_cast<int>(i));
    const auto activity = decode(robot.activity());
    if (!activity) throw WireError("a state with an unknown activity");
    state.world_from_robot[i] = {checkedFinite(robot.x_m()), checkedFinite(robot.y_m()),
                                 checkedFinite(robot.phi_rad())};
    state.speed_mps[i] = checkedFinite(robot.speed_mps());
    state.turn_radps[i] = checkedFinite(robot.turn_radps());
    if (!state.drives.empty()) {
      state.drives[i] = {checkedFinite(robot.lateral_mps()), checkedFinite(robot.steering_rad())};
    }
    state.activity[i] = *activity;
    state.commands[i] = decode(robot.command(), static_cast<std::uint32_t>(i));
  }
  try {
    StateReader objects(in.objects());
    state.objects = readObjects(objects);
    readSpeeds(objects, state);
    state.closed_grippers.clear();
    readGrippers(objects, robots, state);
    if (!objects.isAtEnd()) throw WireError("a state with objects of another form");
  } catch (const InvalidContents& fault) {
    throw WireError(std::string("a state with invalid objects: ") + fault.what());
  }
}

void encode(const Environment& environment, internal::TaskResult& out) {
  out.clear_measurements();
  forMeasurements(environment.fleet(), environment.state().readings, {out.begin(), out.end()},
                  [&](std::size_t, const Measurement& m, const SensorInfo&) { encode(m, *out.add_measurements()); });
}

void put(const internal::TaskResult& in, Environment& environment) {
  const auto readings = environment.phases().results().readings;
  int next = 0;
  forMeasurements(environment.fleet(), readings, {in.begin(), in.end()},
                  [&](std::size_t robot, Measurement& m, const SensorInfo& sensor) {
                    if (next == in.measurements_size()) throw WireError("a result with too few measurements");
                    const auto& measurement = in.measurements(next++);
                    if (environment.state().isAbsent(robot)) return;  // its readings are blank
                    decode(measurement, m);
                    const std::string fault = faultOf(std::get<Echoes>(m), sensor);
                    if (!fault.empty()) throw WireError(fault);
                  });
  if (next != in.measurements_size()) throw WireError("a result with too many measurements");
}

void addCommand(std::size_t robot, const Command& command, internal::Task& out) {
  auto& added = *out.add_commands();
  added.set_world_robot(static_cast<std::uint32_t>(robot));
  encode(command, *added.mutable_command());
}

void putCommands(const internal::Task& in, Environment& environment) {
  for (const auto& order : in.commands()) {
    const std::size_t robot = checkedRobot(order.world_robot(), {0, environment.robotCount()});
    environment.setCommand(robot, decode(order.command(), order.world_robot()));
  }
}

void encodeOutcome(Environment& environment, internal::Task& out) {
  const PhaseResults results = environment.phases().results();
  for (std::size_t i = 0; i < environment.robotCount(); ++i) {
    const auto robot = static_cast<std::uint32_t>(i);
    const double fraction = results.paths[i].end_fraction;
    if (fraction < 1) {
      auto& clipped = *out.add_clipped();
      clipped.set_world_robot(robot);
      clipped.set_fraction(fraction);
    }
    if (results.stays[i]) out.add_staying(robot);
  }
}

void putOutcome(const internal::Task& in, Environment& environment) {
  const RobotRange every{0, environment.robotCount()};
  const PhaseResults results = environment.phases().results();
  for (const auto& clipped : in.clipped()) {
    results.paths[checkedRobot(clipped.world_robot(), every)].end_fraction = checkedFraction(clipped.fraction());
  }
  for (const auto robot : in.staying()) results.stays[checkedRobot(robot, every)] = 1;
}

}  // namespace robosim
