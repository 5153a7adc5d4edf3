#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "recording/recorded_step.h"
#include "robosim/interrupt.h"
#include "robosim/local_run.h"
#include "robosim/progress.h"
#include "robosim/replay.h"
#include "robosim/run_note.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"

namespace robosim {
namespace {

/// A number so that it is read back as the same one.
std::string exactly(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string differ(const std::string& what, double recorded, double now) {
  return what + ": recorded " + exactly(recorded) + ", now " + exactly(now);
}

/// Where two measurements of a sensor differ first; nullopt when they are the same.
struct MeasurementDifference {
  const Measurement& now;

  std::optional<std::string> operator()(const Echoes& recorded) const {
    const auto& here = std::get<Echoes>(now);
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      const std::string beam = "beam " + std::to_string(i);
      if (recorded[i].range_m != here[i].range_m) return differ(beam + " [m]", recorded[i].range_m, here[i].range_m);
      if (recorded[i].point_m != here[i].point_m) return beam + ": its echo comes from elsewhere";
    }
    return std::nullopt;
  }
  std::optional<std::string> operator()(const Scalar& recorded) const {
    const double here = std::get<Scalar>(now).value;
    return recorded.value == here ? std::nullopt : std::make_optional(differ("value", recorded.value, here));
  }
  std::optional<std::string> operator()(const Contacts& recorded) const {
    const auto& here = std::get<Contacts>(now);
    for (std::size_t i = 0; i < recorded.pressed.size(); ++i) {
      if (recorded.pressed[i] == here.pressed[i]) continue;
      return differ("segment " + std::to_string(i), recorded.pressed[i], here.pressed[i]);
    }
    return std::nullopt;
  }
  std::optional<std::string> operator()(const Odometry& recorded) const {
    const auto& here = std::get<Odometry>(now);
    const auto& a = recorded.odom_from_robot;
    const auto& b = here.odom_from_robot;
    if (a.x != b.x) return differ("x [m]", a.x, b.x);
    if (a.y != b.y) return differ("y [m]", a.y, b.y);
    if (a.phi != b.phi) return differ("heading [rad]", a.phi, b.phi);
    if (recorded.speed_mps != here.speed_mps) return differ("speed [m/s]", recorded.speed_mps, here.speed_mps);
    if (recorded.turn_radps != here.turn_radps) return differ("turn [rad/s]", recorded.turn_radps, here.turn_radps);
    return std::nullopt;
  }
  // A picture differs with the driver that drew it (doc/decisions/pictures.md), and is not read.
  std::optional<std::string> operator()(const Image&) const { return std::nullopt; }
  std::optional<std::string> operator()(const Blobs&) const { return std::nullopt; }
};

std::optional<std::string> differenceOf(const RecordedRobot& recorded, const RobotInfo& robot, const Readings& now,
                                        const mrpt::math::TPose2D& world_from_robot, bool is_told_of_winner) {
  if (const auto& truth = recorded.world_from_robot) {
    // A heading is recorded as a matrix, whose angle is the same but for rounding.
    constexpr double kRounding_rad = 1e-12;
    if (truth->x != world_from_robot.x) return differ("true x [m]", truth->x, world_from_robot.x);
    if (truth->y != world_from_robot.y) return differ("true y [m]", truth->y, world_from_robot.y);
    if (std::abs(std::remainder(truth->phi - world_from_robot.phi, 2 * M_PI)) > kRounding_rad) {
      return differ("true heading [rad]", truth->phi, world_from_robot.phi);
    }
  }
  for (std::size_t i = 0; i < now.measurements.size(); ++i) {
    const auto difference = std::visit(MeasurementDifference{now.measurements[i]}, recorded.readings.measurements[i]);
    if (difference) return (*robot.sensors)[i].label + ", " + *difference;
  }
  if (recorded.command && recorded.readings.stalled != now.stalled) {
    return std::string("stalled: recorded ") + (recorded.readings.stalled ? "yes" : "no");
  }
  if (recorded.command && is_told_of_winner && recorded.readings.winner != now.winner) {
    return "winner: recorded \"" + recorded.readings.winner + "\", now \"" + now.winner + '"';
  }
  if (recorded.readings.inbox != now.inbox) {
    return "messages: recorded " + std::to_string(recorded.readings.inbox.size()) + ", now " +
           std::to_string(now.inbox.size());
  }
  return std::nullopt;
}

class RunAgain {
 public:
  RunAgain(const ReplayArguments& arguments, const RunNote& note)
      : note_(note),
        source_(readWorldSource(arguments.check)),
        run_(worldWithControllers(source_, note), options(note), elsewhere(note)),
        reader_(arguments.rawlog),
        recorded_(reader_, robots(), note.period_s, Pictures::leave_out) {}

  /// @return whether the run is the same
  bool check() {
    if (versionOf(source_) != note_.world_version) {
      std::cout << "The world has changed since it was recorded (or is another one).\n";
    }
    const Interrupt interrupt;
    Progress progress;
    auto now = recorded_.next();
    if (now) checkDriven(*now);
    std::uint64_t steps = 0;
    while (now) {
      if (interrupt.asked()) throw std::runtime_error("interrupted; nothing was decided");
      if (const auto difference = firstDifference(*now)) {
        const SimTime time = run_.environment().time();
        std::cout << "Not the same run. It first differs in step " << time.step << " (" << fixed(time.seconds(), 3)
                  << " s): " << *difference << '\n';
        return false;
      }
      if (progress.due()) progress.show("step " + withCommas(steps) + " is the same …");
      ++steps;
      now = recorded_.next();
      if (now) step(*now);
    }
    if (steps == 0) {
      throw ConfigError(printable(reader_.trouble().value_or("the recording")) + "; it has no whole step to compare");
    }
    if (reader_.trouble()) {
      std::cout << printable(*reader_.trouble()) << '\n'
                << "What there is, " << withCommas(steps) << " steps, is the same.\n";
      return true;
    }
    return sameDigest(steps);
  }

 private:
  static RunOptions options(const RunNote& note) {
    RunOptions options;
    options.environment.seed = note.seed;
    options.environment.period_s = note.period_s;
    return options;
  }
  /// Each robot with the controller that it had.
  static LoadedWorld worldWithControllers(const WorldSource& source, const RunNote& note) {
    LoadedWorld world = loadWorldToRun(source, "");
    auto& robots = world.fleet.robots;
    if (note.controllers.size() != robots.size()) {
      throw ConfigError(source.file + ": has " + std::to_string(robots.size()) + " robots, and the recording " +
                        std::to_string(note.controllers.size()) + "; give the world that it was made with, " +
                        note.world.file);
    }
    for (std::size_t i = 0; i < robots.size(); ++i) robots[i].controller = note.controllers[i];
    return world;
  }
  /// Who was driven from elsewhere is driven by the recorded commands.
  static std::vector<std::uint8_t> elsewhere(const RunNote& note) {
    std::vector<std::uint8_t> elsewhere;
    for (const auto& controller : note.controllers) elsewhere.push_back(controller.empty() ? 1 : 0);
    return elsewhere;
  }
  /// Controllers decide the same again, but what somebody else had a robot do and say must all be in the recording.
  void checkDriven(const std::vector<RecordedRobot>& recorded) const {
    const auto absent = std::find_if(recorded.begin(), recorded.end(), [](const auto& r) { return r.is_absent; });
    const auto driven = std::find(note_.controllers.begin(), note_.controllers.end(), "");
    if (absent == recorded.end() || driven == note_.controllers.end()) return;
    const auto& robots = run_.environment().fleet().robots;
    throw ConfigError("robot " + robots[static_cast<std::size_t>(driven - note_.controllers.begin())].info.name +
                      " was driven from elsewhere, and robot " +
                      robots[static_cast<std::size_t>(absent - recorded.begin())].info.name +
                      " is not in this recording, so the run cannot be had again; record with --rawlog-format obs");
  }
  /// Only its own recording knows that a robot has won.
  bool isToldOfWinner(const std::vector<RecordedRobot>& recorded, const std::string& winner) const {
    const auto& robots = run_.environment().fleet().robots;
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      if (recorded[i].is_absent && robots[i].info.name == winner) return false;
    }
    return true;
  }
  std::vector<RobotInfo> robots() const {
    std::vector<RobotInfo> robots;
    for (const auto& robot : run_.environment().fleet().robots) robots.push_back(robot.info);
    return robots;
  }
  std::optional<std::string> firstDifference(const std::vector<RecordedRobot>& recorded) const {
    const Environment& environment = run_.environment();
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      if (recorded[i].is_absent) continue;
      const auto& robot = environment.fleet().robots[i].info;
      const auto difference =
          differenceOf(recorded[i], robot, environment.state().readings[i], environment.state().world_from_robot[i],
                       isToldOfWinner(recorded, environment.state().readings[i].winner));
      if (difference) return "robot " + robot.name + ", " + *difference;
    }
    return std::nullopt;
  }
  void step(const std::vector<RecordedRobot>& next) {
    Environment& environment = run_.environment();
    const auto& robots = environment.fleet().robots;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (note_.controllers[i].empty() && next[i].command) {
        environment.setCommand(i, *next[i].command);
        const Readings& answer = next[i].readings;
        const bool has_just_won =
            answer.winner == robots[i].info.name && environment.state().readings[i].winner.empty();
        if (answer.is_too_far || has_just_won) environment.checkWin(i);
      }
      for (const auto& message : next[i].readings.inbox) {
        const auto sender = static_cast<std::size_t>(
            std::find_if(robots.begin(), robots.end(), [&](const auto& r) { return r.info.name == message.from; }) -
            robots.begin());
        if (sender < robots.size() && note_.controllers[sender].empty()) {
          environment.send(sender, message.to, message.text);
        }
      }
    }
    run_.step();
  }

  bool sameDigest(std::uint64_t steps) const {
    const auto note = RunNote::parse(recorded_.note());
    const std::string recorded = note ? note->outcome.value("digest", "") : "";
    const std::string now = run_.environment().digest();
    if (recorded.empty()) {
      std::cout << "All " << withCommas(steps) << " steps are the same; the recording has no digest.\n";
      return true;
    }
    if (recorded != now) {
      std::cout << "Every reading is the same, but not the digest: recorded " << recorded << ", now " << now << '\n';
      return false;
    }
    std::cout << "The same run: " << withCommas(steps) << " steps, digest " << now << '\n';
    return true;
  }

  const RunNote& note_;
  WorldSource source_;
  LocalRun run_;
  RawlogReader reader_;
  RecordedSteps recorded_;
};

}  // namespace

void checkRun(const ReplayArguments& arguments) {
  const RunNote note = RunNote::of(arguments.rawlog);
  if (!RunAgain(arguments, note).check()) throw Exit{kRunFailed};
}

}  // namespace robosim
