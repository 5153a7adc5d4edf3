#include "wire/viewed_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/error_list.h"
#include "environment/environment.h"
#include "hardware/led_color.h"
#include "net/robot_wire.h"
#include "robots/added_robot.h"
#include "wire/world_wire.h"
#include "world/intervention.h"

namespace robosim {
namespace {

void decodeRobot(const v1::RobotView& in, RobotSnapshot& out) {
  if (!std::isfinite(in.x_m()) || !std::isfinite(in.y_m()) || !std::isfinite(in.phi_rad()) ||
      !std::isfinite(in.laser_pan_rad())) {
    throw WireError("a frame with a pose that is not finite");
  }
  const auto activity = decode(in.activity());
  if (!activity) {
    throw WireError("a frame with the unknown activity " + std::to_string(in.activity()));
  }
  out.world_from_robot = {in.x_m(), in.y_m(), in.phi_rad()};
  out.laser_pan_rad = in.laser_pan_rad();
  out.stalled = in.stalled();
  out.led_color = in.led_color() & kLedColorMax;
  out.activity = *activity;
}

void add(const Readings& readings, std::size_t robot, std::optional<std::uint64_t>& sent_step, v1::Frame& out) {
  auto& view = *out.add_readings();
  view.set_world_robot(static_cast<std::uint32_t>(robot));
  encode(readings, *view.mutable_readings(), sent_step);
  sent_step = readings.time.step;
  for (auto& measurement : *view.mutable_readings()->mutable_measurements()) {
    if (!measurement.jpeg().empty() || !measurement.raw_picture().empty()) measurement.Clear();
  }
}

void addRobots(const google::protobuf::RepeatedPtrField<std::string>& elements, Fleet& fleet) {
  if (static_cast<std::size_t>(elements.size()) > kAddedRobotsMax)
    throw WireError("a frame with too many added robots");
  for (const std::string& element : elements) {
    const Change change = parseChange(element, "added robot");
    const auto* robot = std::get_if<AddRobot>(&change);
    if (!robot) throw WireError("a frame with an invalid added robot");
    fleet = withRobot(std::move(fleet), *robot);
  }
}

/// Replaces the world; the state of its robots is reset.
void loadWorldFrom(ViewedRun& run, const v1::Frame& frame) {
  const v1::FrameWorld& world = frame.world();
  if (!(world.period_s() > 0 && world.period_s() <= 1)) throw WireError("a frame whose time step is not in (0, 1] s");
  run.world = loadWorld(decode(world.source()), {});
  addRobots(world.added_robots(), run.world.fleet);
  run.world_version = world.world_version();
  run.period_s = world.period_s();
  run.may_operate = world.may_operate();
  const auto& robots = run.world.fleet.robots;
  run.snapshot.robots.assign(robots.size(), {});
  run.spare_readings.assign(robots.size(), {});
  if (static_cast<std::size_t>(frame.robots_size()) != robots.size()) {
    throw WireError("a first frame that shows " + std::to_string(frame.robots_size()) + " of " +
                    std::to_string(robots.size()) + " robots");
  }
}

/// Stores the steps at which a robot's pictures were taken.
void notePictureSteps(ViewedRun& run, const v1::ReadingsView& of) {
  for (int i = 0; i < of.readings().measurements_size(); ++i) {
    const auto& measurement = of.readings().measurements(i);
    if (measurement.jpeg().empty()) continue;
    run.picture_steps[{of.world_robot(), static_cast<std::size_t>(i)}] = measurement.step();
  }
}

/// Readings to fill for a robot of a frame, which may be listed twice.
Readings& takeReadings(ViewedRun& run, std::size_t robot) {
  auto& readings = run.snapshot.robots[robot].readings;
  auto& spare = run.spare_readings[robot];
  if (readings) return *readings;
  if (!spare) return readings.emplace(blankReadings(*run.world.fleet.robots[robot].info.sensors));
  readings = std::exchange(spare, std::nullopt);
  return *readings;
}

ChangedObjects decode(const v1::FrameObjects& in) {
  if (in.are_of_world()) return {};
  std::vector<WorldObject> objects;
  for (const std::string& element : in.elements()) {
    try {
      const Change change = parseChange(element, "object");
      if (const auto* added = std::get_if<AddObject>(&change)) {
        objects.push_back(added->object);
        continue;
      }
    } catch (const ConfigError&) {
    }
    throw WireError("a frame with an invalid object");
  }
  return ChangedObjects(std::move(objects));
}

void moveObjects(const google::protobuf::RepeatedPtrField<v1::ObjectPlace>& places, ViewedRun& run) {
  std::vector<WorldObject> objects = run.snapshot.objects.orThose(run.world.world.objects);
  for (const v1::ObjectPlace& place : places) {
    if (place.object() >= objects.size()) throw WireError("a frame with an object that the world does not have");
    const mrpt::math::TPose2D at(place.x_m(), place.y_m(), place.phi_rad());
    if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.phi)) {
      throw WireError("a frame with an object whose place is not finite");
    }
    objects[place.object()].body.world_from_body = at;
  }
  run.snapshot.objects = ChangedObjects(std::move(objects));
}

void checkRobot(std::uint32_t robot, const ViewedRun& run) {
  if (robot >= run.snapshot.robots.size()) throw WireError("a frame with a robot that the world does not have");
}

}  // namespace

std::optional<std::uint64_t> ViewedRun::pictureStep(std::size_t robot, std::size_t sensor) const {
  const auto found = picture_steps.find({robot, sensor});
  return found == picture_steps.end() ? std::nullopt : std::optional(found->second);
}

void encode(const ReadingsSelection& selection, v1::FrameRequest& out) {
  out.set_readings_of_all(selection.of_all);
  out.mutable_readings_of()->Assign(selection.of.begin(), selection.of.end());
}

ReadingsSelection decode(const v1::FrameRequest& in, std::size_t robots) {
  ReadingsSelection selection{in.readings_of_all(), {}};
  std::copy_if(in.readings_of().begin(), in.readings_of().end(), std::back_inserter(selection.of),
               [robots](std::uint32_t robot) { return robot < robots; });
  std::sort(selection.of.begin(), selection.of.end());
  selection.of.erase(std::unique(selection.of.begin(), selection.of.end()), selection.of.end());
  return selection;
}

void encode(const ChangedObjects& changed, const std::vector<WorldObject>& sent, v1::Frame& out) {
  const std::vector<WorldObject> none;
  const auto& objects = changed.orThose(none);
  const auto moved = changed.areChanged() ? movedBetween(sent, objects) : std::nullopt;
  if (moved) {
    for (const auto i : *moved) {
      const auto& pose = objects[i].body.world_from_body;
      v1::ObjectPlace& place = *out.add_moved_objects();
      place.set_object(i);
      place.set_x_m(pose.x);
      place.set_y_m(pose.y);
      place.set_phi_rad(pose.phi);
    }
    return;
  }
  v1::FrameObjects& all = *out.mutable_objects();
  all.set_are_of_world(!changed.areChanged());
  for (const WorldObject& object : objects) all.add_elements(changeText(AddObject{object}));
}

void encode(const RobotSnapshot& snapshot, std::size_t robot, v1::RobotView& out) {
  out.set_world_robot(static_cast<std::uint32_t>(robot));
  out.set_x_m(snapshot.world_from_robot.x);
  out.set_y_m(snapshot.world_from_robot.y);
  out.set_phi_rad(snapshot.world_from_robot.phi);
  out.set_laser_pan_rad(snapshot.laser_pan_rad);
  out.set_stalled(snapshot.stalled);
  out.set_activity(encode(snapshot.activity));
  out.set_led_color(snapshot.led_color);
}

void encode(const std::vector<Readings>& readings, const ReadingsSelection& selection, SentSteps& sent_steps,
            v1::Frame& out) {
  if (selection.of_all) {
    for (std::size_t i = 0; i < readings.size(); ++i) add(readings[i], i, sent_steps[i], out);
    return;
  }
  for (const auto robot : selection.of) {
    if (robot < readings.size()) add(readings[robot], robot, sent_steps[robot], out);
  }
}

bool update(ViewedRun& run, const v1::Frame& frame) {
  if (frame.has_world()) {
    loadWorldFrom(run, frame);
    run.snapshot.objects = {};
  }
  if (frame.has_objects()) run.snapshot.objects = decode(frame.objects());
  if (frame.moved_objects_size() > 0) moveObjects(frame.moved_objects(), run);
  run.winner = frame.winner();
  RunSnapshot& snapshot = run.snapshot;
  snapshot.step = frame.step();
  snapshot.time_s = frame.time_s();
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    auto& readings = snapshot.robots[i].readings;
    if (readings) run.spare_readings[i] = std::exchange(readings, std::nullopt);
  }
  for (const auto& robot : frame.robots()) {
    checkRobot(robot.world_robot(), run);
    decodeRobot(robot, snapshot.robots[robot.world_robot()]);
  }
  run.picture_steps.clear();
  for (const auto& of : frame.readings()) {
    checkRobot(of.world_robot(), run);
    const RobotInfo& robot = run.world.fleet.robots[of.world_robot()].info;
    Readings& readings = takeReadings(run, of.world_robot());
    readings.time = {snapshot.step, run.period_s};
    decode(of.readings(), robot.name, readings);
    notePictureSteps(run, of);
  }
  return frame.has_world();
}

}  // namespace robosim
