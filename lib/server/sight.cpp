#include "server/sight.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "net/robot_wire.h"
#include "server/world_wire.h"

namespace robosim {
namespace {

RobotLook lookAt(const wire::RobotView& in) {
  if (!std::isfinite(in.x_m()) || !std::isfinite(in.y_m()) || !std::isfinite(in.phi_rad()) ||
      !std::isfinite(in.laser_pan_rad())) {
    throw WireError("a frame in which a robot is nowhere: its pose is not finite");
  }
  if (!wire::Activity_IsValid(in.activity())) {
    throw WireError("a frame with the unknown activity " + std::to_string(in.activity()));
  }
  return {{in.x_m(), in.y_m(), in.phi_rad()}, in.laser_pan_rad(), in.stalled(), static_cast<Activity>(in.activity())};
}

void add(const Readings& readings, std::size_t robot, wire::Frame& out) {
  auto& view = *out.add_readings();
  view.set_robot(static_cast<std::uint32_t>(robot));
  encode(readings, *view.mutable_readings());
  for (auto& measurement : *view.mutable_readings()->mutable_measurements()) measurement.clear_jpeg();
}

/// Another world: all of it, with nothing known of its robots as yet.
void take(Sight& sight, const wire::Frame& frame) {
  if (!(frame.period_s() > 0 && frame.period_s() <= 1)) throw WireError("a frame whose time step is not in (0, 1] s");
  sight.world = loadWorld(decode(frame.world()), {});
  sight.world_version = frame.world_version();
  sight.period_s = frame.period_s();
  sight.may_operate = frame.may_operate();
  const auto& robots = sight.world.fleet.robots;
  sight.robots.assign(robots.size(), {});
  sight.has_readings.assign(robots.size(), 0);
  sight.readings.clear();
  for (const auto& robot : robots) sight.readings.push_back(blankReadings(*robot.info.sensors));
  if (static_cast<std::size_t>(frame.robots_size()) != robots.size()) {
    throw WireError("a first frame that does not show every robot");
  }
}

void checkRobot(std::uint32_t robot, const Sight& sight) {
  if (robot >= sight.robots.size()) throw WireError("a frame with a robot that the world does not have");
}

}  // namespace

void encode(const ReadingsWish& wish, wire::FrameRequest& out) {
  out.set_readings_of_all(wish.of_all);
  out.mutable_readings_of()->Assign(wish.of.begin(), wish.of.end());
}

ReadingsWish decode(const wire::FrameRequest& in, std::size_t robots) {
  ReadingsWish wish{in.readings_of_all(), {}};
  std::copy_if(in.readings_of().begin(), in.readings_of().end(), std::back_inserter(wish.of),
               [robots](std::uint32_t robot) { return robot < robots; });
  std::sort(wish.of.begin(), wish.of.end());
  wish.of.erase(std::unique(wish.of.begin(), wish.of.end()), wish.of.end());
  return wish;
}

void encode(const RobotLook& look, std::size_t robot, wire::RobotView& out) {
  out.set_robot(static_cast<std::uint32_t>(robot));
  out.set_x_m(look.world_from_robot.x);
  out.set_y_m(look.world_from_robot.y);
  out.set_phi_rad(look.world_from_robot.phi);
  out.set_laser_pan_rad(look.laser_pan_rad);
  out.set_stalled(look.stalled);
  out.set_activity(static_cast<wire::Activity>(look.activity));
}

void encode(const std::vector<Readings>& readings, const ReadingsWish& wish, wire::Frame& out) {
  if (wish.of_all) {
    for (std::size_t i = 0; i < readings.size(); ++i) add(readings[i], i, out);
    return;
  }
  for (const auto robot : wish.of) {
    if (robot < readings.size()) add(readings[robot], robot, out);
  }
}

bool update(Sight& sight, const wire::Frame& frame) {
  if (frame.has_world()) take(sight, frame);
  sight.step = frame.step();
  sight.time_s = frame.time_s();
  sight.winner = frame.winner();
  for (const auto& robot : frame.robots()) {
    checkRobot(robot.robot(), sight);
    sight.robots[robot.robot()] = lookAt(robot);
  }
  std::fill(sight.has_readings.begin(), sight.has_readings.end(), 0);
  for (const auto& of : frame.readings()) {
    checkRobot(of.robot(), sight);
    Readings& readings = sight.readings[of.robot()];
    readings.time = {sight.step, sight.period_s};
    decode(of.readings(), sight.world.fleet.robots[of.robot()].info.name, readings);
    sight.has_readings[of.robot()] = 1;
  }
  return frame.has_world();
}

}  // namespace robosim
