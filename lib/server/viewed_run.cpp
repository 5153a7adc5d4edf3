#include "server/viewed_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "net/robot_wire.h"
#include "server/world_wire.h"

namespace robosim {
namespace {

void decodeRobot(const wire::RobotView& in, RobotSnapshot& out) {
  if (!std::isfinite(in.x_m()) || !std::isfinite(in.y_m()) || !std::isfinite(in.phi_rad()) ||
      !std::isfinite(in.laser_pan_rad())) {
    throw WireError("a frame with a pose that is not finite");
  }
  if (!wire::Activity_IsValid(in.activity())) {
    throw WireError("a frame with the unknown activity " + std::to_string(in.activity()));
  }
  out.world_from_robot = {in.x_m(), in.y_m(), in.phi_rad()};
  out.laser_pan_rad = in.laser_pan_rad();
  out.stalled = in.stalled();
  out.activity = static_cast<Activity>(in.activity());
}

void add(const Readings& readings, std::size_t robot, wire::Frame& out) {
  auto& view = *out.add_readings();
  view.set_robot(static_cast<std::uint32_t>(robot));
  encode(readings, *view.mutable_readings());
  for (auto& measurement : *view.mutable_readings()->mutable_measurements()) measurement.clear_jpeg();
}

/// Replaces the world; the state of its robots is reset.
void loadWorldFrom(ViewedRun& run, const wire::Frame& frame) {
  if (!(frame.period_s() > 0 && frame.period_s() <= 1)) throw WireError("a frame whose time step is not in (0, 1] s");
  run.world = loadWorld(decode(frame.world()), {});
  run.world_version = frame.world_version();
  run.period_s = frame.period_s();
  run.may_operate = frame.may_operate();
  const auto& robots = run.world.fleet.robots;
  run.snapshot.robots.assign(robots.size(), {});
  run.spare_readings.assign(robots.size(), {});
  if (static_cast<std::size_t>(frame.robots_size()) != robots.size()) {
    throw WireError("a first frame that does not show every robot");
  }
}

/// Decodes the steps at which a robot's pictures were taken.
void decodePictureTimes(ViewedRun& run, const wire::ReadingsView& of) {
  for (const auto& time : of.picture_times()) {
    if (time.sensor() >= run.readingsOf(of.robot())->measurements.size() || time.step() > run.snapshot.step) {
      throw WireError("a frame of step " + std::to_string(run.snapshot.step) + " with a picture of sensor " +
                      std::to_string(time.sensor()) + " at step " + std::to_string(time.step()));
    }
    run.picture_steps[{of.robot(), time.sensor()}] = time.step();
  }
}

/// Readings to fill for a robot of a frame, which may be listed twice.
Readings& takeReadings(ViewedRun& run, std::size_t robot) {
  auto& readings = run.snapshot.robots[robot].readings;
  auto& spare = run.spare_readings[robot];
  if (readings) return *readings;
  if (!spare) return readings.emplace(blankReadings(*run.world.fleet.robots[robot].info.sensors));
  readings = std::move(spare);
  spare.reset();
  return *readings;
}

void checkRobot(std::uint32_t robot, const ViewedRun& run) {
  if (robot >= run.snapshot.robots.size()) throw WireError("a frame with a robot that the world does not have");
}

}  // namespace

std::optional<std::uint64_t> ViewedRun::pictureStep(std::size_t robot, std::size_t sensor) const {
  const auto found = picture_steps.find({robot, sensor});
  return found == picture_steps.end() ? std::nullopt : std::optional(found->second);
}

void encode(const ReadingsSelection& selection, wire::FrameRequest& out) {
  out.set_readings_of_all(selection.of_all);
  out.mutable_readings_of()->Assign(selection.of.begin(), selection.of.end());
}

ReadingsSelection decode(const wire::FrameRequest& in, std::size_t robots) {
  ReadingsSelection selection{in.readings_of_all(), {}};
  std::copy_if(in.readings_of().begin(), in.readings_of().end(), std::back_inserter(selection.of),
               [robots](std::uint32_t robot) { return robot < robots; });
  std::sort(selection.of.begin(), selection.of.end());
  selection.of.erase(std::unique(selection.of.begin(), selection.of.end()), selection.of.end());
  return selection;
}

void encode(const RobotSnapshot& snapshot, std::size_t robot, wire::RobotView& out) {
  out.set_robot(static_cast<std::uint32_t>(robot));
  out.set_x_m(snapshot.world_from_robot.x);
  out.set_y_m(snapshot.world_from_robot.y);
  out.set_phi_rad(snapshot.world_from_robot.phi);
  out.set_laser_pan_rad(snapshot.laser_pan_rad);
  out.set_stalled(snapshot.stalled);
  out.set_activity(static_cast<wire::Activity>(snapshot.activity));
}

void encode(const std::vector<Readings>& readings, const ReadingsSelection& selection, wire::Frame& out) {
  if (selection.of_all) {
    for (std::size_t i = 0; i < readings.size(); ++i) add(readings[i], i, out);
    return;
  }
  for (const auto robot : selection.of) {
    if (robot < readings.size()) add(readings[robot], robot, out);
  }
}

bool update(ViewedRun& run, const wire::Frame& frame) {
  if (frame.has_world()) loadWorldFrom(run, frame);
  run.winner = frame.winner();
  RunSnapshot& snapshot = run.snapshot;
  snapshot.step = frame.step();
  snapshot.time_s = frame.time_s();
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    auto& readings = snapshot.robots[i].readings;
    if (readings) run.spare_readings[i] = std::move(readings);
    readings.reset();
  }
  for (const auto& robot : frame.robots()) {
    checkRobot(robot.robot(), run);
    decodeRobot(robot, snapshot.robots[robot.robot()]);
  }
  run.picture_steps.clear();
  for (const auto& of : frame.readings()) {
    checkRobot(of.robot(), run);
    const RobotInfo& robot = run.world.fleet.robots[of.robot()].info;
    Readings& readings = takeReadings(run, of.robot());
    readings.time = {snapshot.step, run.period_s};
    decode(of.readings(), robot.name, readings);
    decodePictureTimes(run, of);
  }
  return frame.has_world();
}

}  // namespace robosim
