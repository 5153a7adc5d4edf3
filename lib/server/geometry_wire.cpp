#include "server/geometry_wire.h"

#include <cmath>

#include "net/robot_wire.h"

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

/// Calls visit(measurement) for all that is measured, by sensors that need not stay home, of a range's robots.
template <typename Visit>
void forMeasurements(Environment& environment, RobotRange range, const Visit& visit) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const auto& sensors = environment.fleet().robots[i].model->sensors;
    for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
      if (!sensors[slot]->staysHome()) visit(environment.measurement(i, slot));
    }
  }
}

}  // namespace

void encode(const Moment& moment, wire::Moment& out) {
  out.Clear();
  out.set_step(moment.step);
  for (std::size_t i = 0; i < moment.commands.size(); ++i) {
    auto& robot = *out.add_robots();
    robot.set_x_m(moment.world_from_robot[i].x);
    robot.set_y_m(moment.world_from_robot[i].y);
    robot.set_phi_rad(moment.world_from_robot[i].phi);
    robot.set_speed_mps(moment.speed_mps[i]);
    robot.set_turn_radps(moment.turn_radps[i]);
    robot.set_activity(static_cast<wire::Activity>(moment.activity[i]));
    encode(moment.commands[i], static_cast<std::uint32_t>(i), *robot.mutable_command());
  }
}

Moment decode(const wire::Moment& in, std::size_t robots) {
  if (static_cast<std::size_t>(in.robots_size()) != robots) throw WireError("a moment of another world");
  Moment moment;
  moment.step = in.step();
  for (const auto& robot : in.robots()) {
    if (!wire::Activity_IsValid(robot.activity())) throw WireError("a moment with an unknown activity");
    moment.world_from_robot.emplace_back(checkedFinite(robot.x_m()), checkedFinite(robot.y_m()),
                                         checkedFinite(robot.phi_rad()));
    moment.speed_mps.push_back(checkedFinite(robot.speed_mps()));
    moment.turn_radps.push_back(checkedFinite(robot.turn_radps()));
    moment.activity.push_back(static_cast<Activity>(robot.activity()));
    moment.commands.push_back(decode(robot.command(), robots));
  }
  return moment;
}

void encode(Environment& environment, wire::TaskResult& out) {
  const RobotRange range{out.begin(), out.end()};
  out.clear_fractions();
  out.clear_stay();
  out.clear_measurements();
  switch (out.part()) {
    case wire::CLIP:
      for (std::size_t i = range.begin; i < range.end; ++i) out.add_fractions(environment.clipped(i));
      break;
    case wire::JUDGE:
      for (std::size_t i = range.begin; i < range.end; ++i) {
        if (environment.stays(i)) out.add_stay(static_cast<std::uint32_t>(i));
      }
      break;
    default:
      forMeasurements(environment, range, [&](const Measurement& m) { encode(m, *out.add_measurements()); });
  }
}

void put(const wire::TaskResult& in, Environment& environment) {
  const RobotRange range{in.begin(), in.end()};
  switch (in.part()) {
    case wire::CLIP:
      if (static_cast<std::size_t>(in.fractions_size()) != range.end - range.begin) {
        throw WireError("a result of another size than its range");
      }
      for (std::size_t i = range.begin; i < range.end; ++i) {
        environment.putClipped(i, checkedFraction(in.fractions(static_cast<int>(i - range.begin))));
      }
      break;
    case wire::JUDGE:
      for (std::size_t i = range.begin; i < range.end; ++i) environment.putStays(i, false);
      for (const auto robot : in.stay()) environment.putStays(checkedRobot(robot, range), true);
      break;
    default: {
      int next = 0;
      forMeasurements(environment, range, [&](Measurement& m) {
        if (next == in.measurements_size()) throw WireError("a result with too few measurements");
        decode(in.measurements(next++), m);
      });
      if (next != in.measurements_size()) throw WireError("a result with too many measurements");
    }
  }
}

void encodeOutcome(const Environment& environment, wire::Task& out) {
  for (std::size_t i = 0; i < environment.robotCount(); ++i) {
    const auto robot = static_cast<std::uint32_t>(i);
    if (out.part() == wire::JUDGE && environment.clipped(i) < 1) {
      out.add_clipped(robot);
      out.add_clipped_fractions(environment.clipped(i));
    }
    if (out.part() == wire::SENSE && environment.stays(i)) out.add_stay(robot);
  }
}

void putOutcome(const wire::Task& in, Environment& environment) {
  const RobotRange every{0, environment.robotCount()};
  if (in.part() == wire::JUDGE) {
    if (in.clipped_size() != in.clipped_fractions_size()) throw WireError("clipped robots without their fractions");
    for (std::size_t i = 0; i < every.end; ++i) environment.putClipped(i, 1);
    for (int k = 0; k < in.clipped_size(); ++k) {
      environment.putClipped(checkedRobot(in.clipped(k), every), checkedFraction(in.clipped_fractions(k)));
    }
  }
  if (in.part() == wire::SENSE) {
    for (std::size_t i = 0; i < every.end; ++i) environment.putStays(i, false);
    for (const auto robot : in.stay()) environment.putStays(checkedRobot(robot, every), true);
  }
}

}  // namespace robosim
