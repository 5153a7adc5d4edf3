#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>

#include "base/interrupt.h"
#include "base/printable_text.h"
#include "base/text_table.h"
#include "control/controller_error.h"
#include "control/replayed_hardware.h"
#include "recording/recorded_step.h"
#include "replay/replay.h"
#include "replay/value_text.h"
#include "run/local_run.h"
#include "run/outputs/run_note.h"

namespace robosim {
namespace {

/// Of two commands to a robot, in the units of their fields; infinite if something that has no measure differs. What
/// has no effect on the robot is not recorded, and not compared.
double biggestDifference(const RobotInfo& robot, const Command& a, const Command& b) {
  if (a.activity != b.activity || a.emergency_stop != b.emergency_stop || a.grip != b.grip ||
      a.led_color != b.led_color) {
    return std::numeric_limits<double>::infinity();
  }
  double biggest = std::max({std::abs(a.speed_mps - b.speed_mps), std::abs(a.turn_radps - b.turn_radps),
                             static_cast<double>(std::abs(a.laser_pan_rad - b.laser_pan_rad))});
  if (robot.type->limits.lateral_max_mps > 0) biggest = std::max(biggest, std::abs(a.lateral_mps - b.lateral_mps));
  if (!cameraHeadIn(*robot.sensors)) return biggest;
  const CameraHeadCommand &head_a = *a.camera_head, &head_b = *b.camera_head;
  return std::max({biggest, std::abs(head_a.aim.pan_rad - head_b.aim.pan_rad),
                   std::abs(head_a.aim.tilt_rad - head_b.aim.tilt_rad), std::abs(head_a.aim.zoom - head_b.aim.zoom),
                   std::abs(head_a.pan_radps - head_b.pan_radps), std::abs(head_a.tilt_radps - head_b.tilt_radps)});
}

/// A controller running on the recording of one robot.
struct Replayed {
  Replayed(const RobotInfo& info, const std::vector<std::string>& names, std::string controller_name_in,
           std::unique_ptr<Controller> c)
      : hardware(info, names),
        robot(hardware),
        controller_name(std::move(controller_name_in)),
        controller(std::move(c)) {}

  ReplayedHardware hardware;
  Robot robot;
  std::string controller_name;
  std::unique_ptr<Controller> controller;
  std::uint64_t compared = 0, different = 0;
  double biggest = 0;
  std::string first;

  void compare(const RecordedRobot& next, double tolerance) {
    if (!next.command) return;
    ++compared;
    const double difference = biggestDifference(hardware.info(), hardware.lastCommand(), *next.command);
    biggest = std::max(biggest, difference);
    if (difference <= tolerance) return;
    if (++different > 1) return;
    const SimTime& time = next.readings.time;
    first = "step " + std::to_string(time.step) + " (" + fixed(time.seconds(), 3) + " s): recorded " +
            inWords(*next.command) + "; now " + inWords(hardware.lastCommand());
  }
};

}  // namespace

ReplayResult replayToController(const ReplayArguments& arguments) {
  const RunNote note = RunNote::of(arguments.rawlog);
  if (note.world.text.empty()) {
    throw ConfigError(arguments.rawlog + ": its world is too large to be stored in it; --check WORLD repeats the run");
  }
  const LoadedWorld world = loadWorld(note.world, {});
  std::vector<std::string> names;
  for (const auto& robot : world.fleet.robots) names.push_back(robot.info.name);
  std::vector<RobotInfo> infos;
  std::vector<std::unique_ptr<Replayed>> robots;  // by robot of the world; null for robots not selected
  for (const auto& robot : world.fleet.robots) {
    const std::size_t i = infos.size();
    infos.push_back(robot.info);
    const std::string recorded = i < note.controllers.size() ? note.controllers[i] : "";
    const std::string name = arguments.controller == "recorded" ? recorded : arguments.controller;
    const bool is_selected = arguments.selects(robot.info.name, "") || arguments.robots.empty();
    robots.push_back(is_selected && !name.empty()
                         ? std::make_unique<Replayed>(
                               robot.info, names, name,
                               makeController(name, {note.seed, static_cast<std::uint32_t>(i)}, robot.info.name))
                         : nullptr);
  }
  if (std::all_of(robots.begin(), robots.end(), [](const auto& r) { return !r; })) {
    throw ConfigError(arguments.rawlog +
                      ": the selection has no robot to replay; list its robots with robosim replay " +
                      arguments.rawlog);
  }

  const Interrupt interrupt;
  RawlogReader reader(arguments.rawlog, RawlogReader::Access::sequential, arguments.threads);
  RecordedSteps steps(reader, infos, note.period_s);
  bool first = true;
  double read_s = 0;
  while (auto step = steps.next()) {
    if (interrupt.isRequested()) failInterrupted(read_s);
    read_s = step->front().readings.time.seconds();
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if ((*step)[i].is_missing) robots[i].reset();
      if (!robots[i] || isAbsent((*step)[i])) continue;
      // The recorded command of a step was computed from the readings of the previous step.
      if (!first) robots[i]->compare((*step)[i], arguments.tolerance);
      robots[i]->hardware.replay(std::move((*step)[i].readings));
      try {
        robots[i]->controller->step(robots[i]->robot);
      } catch (...) {
        throwControllerError(robots[i]->controller_name, robots[i]->robot.name());
      }
    }
    first = false;
  }

  const auto was_compared = [](const auto& robot) { return robot && robot->compared > 0; };
  if (std::none_of(robots.begin(), robots.end(), was_compared)) {
    throw ConfigError(reader.readError().value_or(arguments.rawlog) +
                      "; it has no two complete steps of a selected robot, so no command to compare");
  }
  if (reader.readError()) std::cout << printableText(*reader.readError()) << '\n';
  Rows rows;
  for (const auto& robot : robots) {
    if (!robot) continue;
    std::string verdict = withCommas(robot->different) + " of " + withCommas(robot->compared) + " commands differ";
    if (robot->different == 0) verdict = "all " + withCommas(robot->compared) + " commands are the recorded ones";
    rows.push_back({robot->robot.name(), verdict});
    if (robot->different > 0) rows.push_back({"", "first in " + robot->first});
  }
  std::cout << listing(rows);
  return resultOf(reader);
}

}  // namespace robosim
