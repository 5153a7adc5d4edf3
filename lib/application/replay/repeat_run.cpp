#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "base/interrupt.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "hardware/measurement_fields.h"
#include "recording/recorded_step.h"
#include "replay/replay.h"
#include "run/json_text.h"
#include "run/local_run.h"
#include "run/outputs/intervention_note.h"
#include "run/outputs/recorded_fleet.h"
#include "run/outputs/run_note.h"
#include "run/run_summary.h"
#include "world/map_reader.h"

namespace robosim {
namespace {

/// A number in a text form that parses to the same value.
std::string exactly(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string differ(const std::string& what, double recorded, double now) {
  return what + ": recorded " + exactly(recorded) + ", now " + exactly(now);
}

/// Position of the first difference between two measurements of a sensor; nullopt if they are equal, and for kinds that
/// differ between machines.
std::optional<std::string> findDifference(const Measurement& recorded_measurement, const Measurement& measurement) {
  return std::visit(
      [&]<typename M>(const M& recorded) -> std::optional<std::string> {
        if constexpr (std::is_same_v<M, Image>) {
          const auto& then = recorded.raw;
          const auto& again = std::get<Image>(measurement).raw;
          const bool is_same = then && again ? *then == *again : !then == !again;
          return is_same ? std::nullopt : std::optional<std::string>("its picture");
        }
        if constexpr (!kIsReproducible<M>) return std::nullopt;
        const auto now = Description<M>::records(std::get<M>(measurement));
        std::optional<std::string> difference;
        forNumbers(recorded, [&](const auto& field, auto number, std::size_t index) {
          const auto here = field.get(now[index]);
          if (difference || number == here) return;
          const std::string record =
              kIsSingle<M> ? "" : Description<M>::record_name + (' ' + std::to_string(index) + ' ');
          const std::string unit = *field.unit.symbol ? std::string(" [") + field.unit.symbol + ']' : "";
          difference = differ(record + field.name + unit, number, here);
        });
        return difference;
      },
      recorded_measurement);
}

std::optional<std::string> findDifference(const RecordedRobot& recorded, const RobotInfo& robot, const Readings& now,
                                          const mrpt::math::TPose2D& world_from_robot, bool receives_winner) {
  if (const auto& truth = recorded.world_from_robot) {
    // A heading is recorded as a matrix; its angle is equal up to rounding.
    constexpr double kRounding_rad = 1e-12;
    if (truth->x != world_from_robot.x) return differ("true x [m]", truth->x, world_from_robot.x);
    if (truth->y != world_from_robot.y) return differ("true y [m]", truth->y, world_from_robot.y);
    if (std::abs(std::remainder(truth->phi - world_from_robot.phi, 2 * M_PI)) > kRounding_rad) {
      return differ("true heading [rad]", truth->phi, world_from_robot.phi);
    }
  }
  for (std::size_t i = 0; i < now.measurements.size(); ++i) {
    const auto difference = findDifference(recorded.readings.measurements[i], now.measurements[i]);
    if (difference) return (*robot.sensors)[i].label + ", " + *difference;
  }
  if (recorded.command && recorded.readings.stalled != now.stalled) {
    return std::string("stalled: recorded ") + (recorded.readings.stalled ? "yes" : "no");
  }
  if (recorded.command && receives_winner && recorded.readings.winner != now.winner) {
    return "winner: recorded \"" + *recorded.readings.winner + "\", now \"" + *now.winner + '"';
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
        verdict_(arguments.json ? std::cerr : std::cout),
        source_(sourceFrom(arguments, note)),
        run_(worldWithControllers(source_, note), options(note, arguments.observers), elsewhere(note)),
        reader_(arguments.rawlog, RawlogReader::Access::sequential, arguments.threads),
        fleet_(run_.environment().fleet()),
        recorded_(reader_, robots(), note.period_s, Pictures::leave_out,
                  [this](const std::string& comment) { return addRecordedRobot(comment, fleet_); }) {}

  bool isDamaged() const { return reader_.isDamaged(); }
  std::vector<Metric> metrics() const { return run_.observers().metrics(); }
  /// @return whether the run is identical
  bool check() {
    if (versionOf(source_) != note_.world_version) {
      verdict_ << "The world has changed since it was recorded (or is another one).\n";
    }
    const Interrupt interrupt;
    Progress progress;
    auto now = recorded_.next();
    if (now) checkDriven(*now);
    if (now) enterAndLeave(*now, {}, isOfWorldFile);
    std::uint64_t steps = 0;
    std::optional<std::string> refused;
    while (now) {
      if (interrupt.isRequested()) throw Interrupted("interrupted; no result");
      if (const auto difference = refused ? refused : firstDifference(*now)) {
        const SimTime time = run_.environment().time();
        verdict_ << "Not the same run. It first differs in step " << time.step << " (" << fixed(time.seconds(), 3)
                 << " s): " << printableText(*difference) << '\n';
        return false;
      }
      if (progress.due()) progress.show("step " + withCommas(steps) + " is the same …");
      ++steps;
      now = recorded_.next();
      if (now) refused = step(*now);
    }
    if (steps == 0) {
      throw ConfigError(reader_.readError().value_or("the recording") + "; it has no complete step to compare");
    }
    if (reader_.readError()) {
      verdict_ << printableText(*reader_.readError()) << '\n'
               << "What there is, " << stepsTaken() << ", is the same.\n";
      return true;
    }
    return sameDigest();
  }

 private:
  static RunOptions options(const RunNote& note, const std::vector<std::string>& observers) {
    RunOptions options;
    options.observers = observers;
    options.observers_supervise = false;
    options.controller_of_added = note.controller_of_added;
    options.is_added_elsewhere = [note](const FleetRobot& robot) { return isAddedElsewhere(note, robot); };
    options.environment.seed = note.seed;
    options.environment.period_s = note.period_s;
    return options;
  }
  /// A bare map has one robot at its home. The recording contains which ones the run has placed on it, and with which
  /// changes, so that only the map's own files are taken from where they are now.
  static WorldSource withRobotsOf(const RunNote& note, const WorldSource& checked) {
    if (!isMapFile(checked.file) || note.without_files.text.empty()) return checked;
    WorldSource source = note.without_files;
    source.file = checked.file;
    source.files = checked.files;
    return source;
  }
  static WorldSource sourceFrom(const ReplayArguments& arguments, const RunNote& note) {
    if (arguments.check.empty() && note.world.text.empty()) {
      throw ConfigError(arguments.rawlog + ": its world is too large to be stored in it; add --check WORLD");
    }
    WorldSource source = arguments.check.empty() ? note.world : withRobotsOf(note, readWorldSource(arguments.check));
    source.seed = note.seed;
    return source;
  }
  /// The recorded controller of each robot.
  static LoadedWorld worldWithControllers(const WorldSource& source, const RunNote& note) {
    // The world's own controllers do not run, and may need sensors that the robots do not have.
    const auto is_any = [](const FleetRobot&, std::size_t) { return true; };
    LoadedWorld world = loadWorldToRun(source, "", is_any);
    auto& robots = world.fleet.robots;
    if (note.controllers.size() != robots.size()) {
      throw ConfigError(source.file + ": has " + std::to_string(robots.size()) + " robots, and the recording " +
                        std::to_string(note.controllers.size()) + "; give the world that it was made with, " +
                        note.world.file);
    }
    for (std::size_t i = 0; i < robots.size(); ++i) robots[i].controller.edit() = note.controllers[i];
    return world;
  }
  /// Robots driven by another process are driven by the recorded commands.
  static std::vector<std::uint8_t> elsewhere(const RunNote& note) {
    std::vector<std::uint8_t> elsewhere;
    for (const auto& controller : note.controllers) elsewhere.push_back(controller.empty() ? 1 : 0);
    return elsewhere;
  }
  /// Controllers recompute their commands; commands and messages from other processes are taken from the recording.
  void checkDriven(const std::vector<RecordedRobot>& recorded) const {
    const auto missing = std::find_if(recorded.begin(), recorded.end(), [](const auto& r) { return r.is_missing; });
    const auto driven = std::find(note_.controllers.begin(), note_.controllers.end(), "");
    if (missing == recorded.end() || driven == note_.controllers.end()) return;
    const auto& robots = run_.environment().fleet().robots;
    throw ConfigError("robot " + robots[static_cast<std::size_t>(driven - note_.controllers.begin())].info.name +
                      " was driven by another process, and robot " +
                      robots[static_cast<std::size_t>(missing - recorded.begin())].info.name +
                      " is not in this recording, so the run cannot be repeated; record with --rawlog-format obs");
  }
  /// That a robot has won is known only from its own recording.
  bool receivesWinner(const std::vector<RecordedRobot>& recorded, const std::string& winner) const {
    const auto& robots = run_.environment().fleet().robots;
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      if (recorded[i].is_missing && robots[i].info.name == winner) return false;
    }
    return true;
  }
  std::vector<RobotInfo> robots() const {
    std::vector<RobotInfo> robots;
    for (const auto& robot : run_.environment().fleet().robots) robots.push_back(robot.info);
    return robots;
  }
  /// Whether another process has driven a robot.
  bool isDrivenElsewhere(std::size_t robot) const {
    if (robot < note_.controllers.size()) return note_.controllers[robot].empty();
    return isAddedElsewhere(note_, run_.environment().fleet().robots[robot]);
  }
  static bool isAddedElsewhere(const RunNote& note, const FleetRobot& robot) {
    const bool has_controller = !note.controller_of_added.empty() || !robot.controller->empty();
    return note.added_elsewhere == RunNote::Elsewhere::all ||
           (note.added_elsewhere == RunNote::Elsewhere::without_controller && !has_controller);
  }
  std::optional<std::string> firstDifference(const std::vector<RecordedRobot>& recorded) const {
    const Environment& environment = run_.environment();
    if (recorded.size() != environment.robotCount()) {
      return "number of robots: recorded " + std::to_string(recorded.size()) + ", now " +
             std::to_string(environment.robotCount());
    }
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      if (recorded[i].is_missing) continue;
      const auto& robot = environment.fleet().robots[i].info;
      const auto difference =
          findDifference(recorded[i], robot, environment.state().readings[i], environment.state().world_from_robot[i],
                         receivesWinner(recorded, environment.state().readings[i].winner));
      if (difference) return "robot " + robot.name + ", " + *difference;
    }
    return std::nullopt;
  }
  /// The interventions of the recording since the last step.
  std::vector<Intervention> interventions() const {
    std::vector<Intervention> made;
    for (const auto& comment : recorded_.comments()) {
      if (auto note = InterventionNote::parse(comment)) made.push_back(std::move(note->intervention));
    }
    return made;
  }
  /// The run itself makes those of the world file, when it begins the step.
  static bool isOfWorldFile(const Intervention& one) { return one.author == kWorldFileAuthor; }
  /// Whether some intervention places or removes a robot.
  template <typename Selected>
  bool isMoved(std::size_t robot, const std::vector<Intervention>& made, const Selected& is_selected) const {
    const std::string& name = run_.environment().robotNames()[robot];
    return std::any_of(made.begin(), made.end(), [&](const Intervention& one) {
      const auto* placed = std::get_if<PlaceBody>(&one.change);
      const auto* removed = std::get_if<RemoveBody>(&one.change);
      return is_selected(one) && ((placed && placed->name == name) || (removed && removed->name == name));
    });
  }
  /// Robots enter the world at their start, and leave it, except those that some interventions place or remove.
  template <typename Selected>
  void enterAndLeave(const std::vector<RecordedRobot>& next, const std::vector<Intervention>& made,
                     const Selected& is_selected) {
    Environment& environment = run_.environment();
    std::vector<std::size_t> absent, present;
    for (std::size_t i = 0; i < std::min(next.size(), environment.robotCount()); ++i) {  // others will be added
      if (isMoved(i, made, is_selected)) continue;
      (isAbsent(next[i]) ? absent : present).push_back(i);
    }
    environment.remove(absent);
    for (const std::size_t i : present) environment.enter(i);
  }
  /// @return why one cannot be repeated
  std::optional<std::string> intervene(const std::vector<Intervention>& made) {
    for (const Intervention& one : made) {
      if (isOfWorldFile(one)) continue;
      const std::string fault = run_.environment().apply(one);
      if (!fault.empty()) return "the intervention of " + one.author + " is impossible now: " + fault;
    }
    return std::nullopt;
  }
  /// @return why the step cannot be repeated
  std::optional<std::string> step(const std::vector<RecordedRobot>& next) {
    const std::vector<Intervention> made = interventions();
    enterAndLeave(next, made, [](const Intervention&) { return true; });
    if (auto refused = intervene(made)) return refused;
    if (!made.empty()) enterAndLeave(next, made, isOfWorldFile);  // also those that were moved before or afterwards
    Environment& environment = run_.environment();
    const auto& robots = environment.fleet().robots;
    for (std::size_t i = 0; i < std::min(next.size(), robots.size()); ++i) {  // the step itself adds others
      if (isDrivenElsewhere(i) && next[i].command) {
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
        if (sender < robots.size() && isDrivenElsewhere(sender)) {
          environment.receive(i, sender, message.text);  // the recording contains what the radio has delivered
        }
      }
    }
    run_.step();
    return std::nullopt;
  }

  /// Number of steps of the run so far, as its summary states it; the recording also contains the start.
  std::string stepsTaken() const { return withCommas(run_.environment().time().step) + " steps"; }

  bool sameDigest() {
    if (const auto refused = intervene(interventions())) {  // those that ended the run
      verdict_ << "Every reading is the same, but at the end " << printableText(*refused) << '\n';
      return false;
    }
    const auto note = RunNote::parse(recorded_.note());
    const std::string recorded = note && note->outcome.is_object() ? note->outcome.value("digest", "") : "";
    const std::string now = run_.environment().digest();
    if (recorded.empty()) {
      verdict_ << "All readings of " << stepsTaken() << " are the same; the recording has no digest.\n";
      return true;
    }
    if (recorded != now) {
      verdict_ << "Every reading is the same, but not the digest: recorded " << recorded << ", now " << now << '\n';
      return false;
    }
    verdict_ << "The same run: " << stepsTaken() << ", digest " << now << '\n';
    return true;
  }

  const RunNote& note_;
  std::ostream& verdict_;  ///< standard output contains only the JSON object, if there is any
  WorldSource source_;
  LocalRun run_;
  RawlogReader reader_;
  Fleet fleet_;  ///< of the recording as far as it has been read
  RecordedSteps recorded_;
};

}  // namespace

ReplayResult checkRun(const ReplayArguments& arguments) {
  const RunNote note = RunNote::of(arguments.rawlog);
  if (note.first_step > 0) {
    throw ConfigError(arguments.rawlog + ": begins at step " + std::to_string(note.first_step) +
                      ", because the recording was started during the run; the run cannot be repeated without the "
                      "commands of the earlier steps: check a recording that begins at step 0");
  }
  RunAgain run(arguments, note);
  const bool is_same = run.check();
  const std::vector<Metric> metrics = run.metrics();
  if (is_same && arguments.json) std::cout << jsonText({{"metrics", metricsJson(metrics)}}) << std::endl;
  if (is_same && !arguments.json) std::cout << listing(metricRows(metrics));
  if (!is_same) return ReplayResult::different;
  return run.isDamaged() ? ReplayResult::damaged : ReplayResult::complete;
}

}  // namespace robosim
