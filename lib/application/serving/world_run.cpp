#include "serving/world_run.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "base/data_folders.h"
#include "base/file_kind.h"
#include "base/log.h"
#include "base/seconds.h"
#include "control/controller_error.h"
#include "net/host_port.h"
#include "recording/recording_error.h"
#include "robots/fleet.h"
#include "robots/world_source.h"
#include "run/local_run.h"
#include "server/run_info.h"

namespace robosim {
namespace {

/// Whether ARCOS programs drive a robot.
bool isDrivenByArcos(const FleetRobot& robot, const WorldRunOptions& options) {
  return options.arcos && isForArcos(robot, *options.arcos, !options.of_run.run.controller.empty());
}

/// Why ARCOS programs drive no robot of a world, and how to change that.
std::string whyNoneIsForArcos(const WorldRunOptions& options) {
  if (options.arcos->has_all) return "none is of a type with <arcos>";
  if (!options.of_run.run.controller.empty()) {
    return "--controller drives them all; leave it out, or add --arcos-all, which serves those of a type with <arcos>";
  }
  return "none of a type with <arcos> is without a controller; --arcos-all serves those with one, too";
}

/// Whether ARCOS programs drive a robot that is added to the run: other ones would need a port.
bool isAddedForArcos(const FleetRobot& robot, const WorldRunOptions& options) {
  return options.arcos && options.arcos->isFactory() && isDrivenByArcos(robot, options);
}

/// @throws ConfigError when ARCOS programs cannot drive robots of the factory's type
void requireArcosType(const Fleet& fleet, const ArcosOptions& options) {
  const auto kind = std::find_if(fleet.robots.begin(), fleet.robots.end(),
                                 [&](const FleetRobot& robot) { return robot.info.type->model == options.factory; });
  if (kind != fleet.robots.end() && kind->model->arcos) return;
  throw ConfigError("--arcos-factory " + options.factory +
                    ": ARCOS programs cannot drive robots of this type, which has no <arcos>; use another one, such as "
                    "p3dx");
}

/// By robot: whether ARCOS programs drive it.
std::vector<std::uint8_t> arcosFlags(const Fleet& fleet, const WorldRunOptions& options) {
  std::vector<std::uint8_t> flags;
  for (const auto& robot : fleet.robots) flags.push_back(isDrivenByArcos(robot, options));
  return flags;
}

/// Whether a process that uses the protocol of RoboSim drives a robot, unless ARCOS programs do: every one, if the
/// environment waits for them; otherwise one without a controller.
bool isNetworked(const FleetRobot& robot, const WorldRunOptions& options) {
  const bool has_controller = !options.of_run.run.controller.empty() || !robot.controller->empty();
  return options.wait_for_robots || !has_controller;
}

/// Robots of isNetworked() that ARCOS programs do not drive.
std::vector<std::uint8_t> networkedRobots(const Fleet& fleet, const WorldRunOptions& options,
                                          const std::vector<std::uint8_t>& is_arcos) {
  std::vector<std::uint8_t> networked;
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    networked.push_back(!is_arcos[i] && isNetworked(fleet.robots[i], options));
  }
  return networked;
}

/// Robots that this process runs no controller for.
std::vector<std::uint8_t> either(std::vector<std::uint8_t> a, const std::vector<std::uint8_t>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] |= b[i];
  return a;
}

RunOptions onRequest(RunOptions options) {
  options.pictures_on_request = true;
  return options;
}

/// "run.rawlog" → "run_2.rawlog" for the second run; an empty name stays empty.
std::string numbered(const std::string& file, int number) {
  if (file.empty() || number == 1) return file;
  const std::filesystem::path path(file);
  return (path.parent_path() / (path.stem().string() + "_" + std::to_string(number) + path.extension().string()))
      .string();
}

}  // namespace

/// One run of one world, with its controllers and outputs.
class WorldRun::OneRun {
 public:
  OneRun(LoadedWorld world, const WorldSource& source, const WorldRunOptions& options, RunArguments of_this_run)
      : arguments(std::move(of_this_run)),
        is_arcos(arcosFlags(world.fleet, options)),
        networked(networkedRobots(world.fleet, options, is_arcos)),
        run(std::move(world), onRequest(arguments.run), either(networked, is_arcos)),
        run_info(run.environment(), source, arguments.run.environment.seed, networked),
        outputs(arguments, run.environment(), makeNote(source, run, arguments.run, either(networked, is_arcos))) {
    if (options.arcos && options.arcos->isFactory()) {
      run.environment().remove(arcosRobots());  // they enter the world with their programs
    }
    requestPictures({});
    outputs.observe(run.environment());
    if (options.is_realtime) late = 0;
  }

  /// Follows the robots that have been added to the environment.
  void addRobots(const WorldRunOptions& options) {
    run.followAdditions();
    std::vector<std::uint8_t> are_networked;
    const auto& robots = run.environment().fleet().robots;
    for (std::size_t i = networked.size(); i < robots.size(); ++i) {
      is_arcos.push_back(isAddedForArcos(robots[i], options) ? 1 : 0);
      are_networked.push_back(!is_arcos[i] && isNetworked(robots[i], options) ? 1 : 0);
    }
    networked.insert(networked.end(), are_networked.begin(), are_networked.end());
    run_info.addRobots(are_networked);
    has_cameras = needsImageSource(run.environment().fleet());
  }

  /// Selects the robots whose cameras take pictures: those of clients, or all for a recording or an observer.
  void requestPictures(std::vector<std::uint8_t> robots) {
    if (!has_cameras) return;
    robots.resize(run.environment().robotCount());
    const RunRecording* recording = outputs.recording();
    if ((recording && recording->isOn()) || observers_read_pictures) robots.assign(robots.size(), 1);
    run.takePictures(robots);
    run.selectPictures(std::move(robots));
  }

  /// Indices of the robots that ARCOS programs drive.
  std::vector<std::size_t> arcosRobots() const {
    std::vector<std::size_t> robots;
    for (std::size_t i = 0; i < is_arcos.size(); ++i) {
      if (is_arcos[i]) robots.push_back(i);
    }
    return robots;
  }

  void finish(EndedBy ended_by) {
    if (std::exchange(is_finished, true)) return;
    outputs.finish(run, secondsSince(start), ended_by, late, report);
    reportRecording();
  }

  /// Logs why a recording has ended before it was stopped, once.
  void reportRecording() {
    const RunRecording* recording = outputs.recording();
    const std::string failure = recording ? recording->failure() : "";
    if (failure == std::exchange(reported, failure) || failure.empty()) return;
    logError("serve", "the recording has ended: " + failure);
  }

  RunArguments arguments;
  std::vector<std::uint8_t> is_arcos;
  std::vector<std::uint8_t> networked;
  LocalRun run;
  RunInfo run_info;
  RunOutputs outputs;
  RunReport report;
  bool has_cameras = needsImageSource(run.environment().fleet());
  bool observers_read_pictures = readPictures(arguments.run.observers);
  std::optional<std::uint64_t> late;  ///< robot-steps whose command came too late
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  bool is_finished = false;  ///< its outputs are written
  std::string reported;      ///< RunRecording::failure() that has been logged
};

class WorldRun::Prepared final : public PreparedRun {
 public:
  explicit Prepared(std::shared_ptr<std::atomic<bool>> has_next) : has_next_(std::move(has_next)) {}
  ~Prepared() override { *has_next_ = false; }
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;

  std::shared_ptr<OneRun> run;
  bool keeps_programs = false;         ///< of ARCOS, which have asked for it
  std::unique_ptr<ArcosServer> arcos;  ///< of makeReady(); null without ARCOS

 private:
  std::shared_ptr<std::atomic<bool>> has_next_;
};

WorldRun::WorldRun(WorldRunOptions options)
    : options_(std::move(options)), run_(load(readRunSource(options_.of_run), 1)) {
  arcos_ = makeArcosServer(*run_);
  logArcosPorts();
  if (options_.live.isNone()) return;
  live_ = std::make_unique<LiveServing>(options_.live);
  beginLive();
}

WorldRun::~WorldRun() = default;

Environment& WorldRun::environment() { return run_->run.environment(); }

std::shared_ptr<const RunInfo> WorldRun::runInfo() const { return {run_, &run_->run_info}; }

/// Opens the ports for a run, and shares those that the present run has open. Null without ARCOS.
std::unique_ptr<ArcosServer> WorldRun::makeArcosServer(OneRun& run) const {
  if (!options_.arcos) return nullptr;
  ArcosOptions options = *options_.arcos;
  options.map_file = run.arguments.world;
  return std::make_unique<ArcosServer>(options, run.run.environment(), run.arcosRobots(), arcos_.get());
}

void WorldRun::logArcosPorts() const {
  if (!arcos_) return;
  const std::vector<std::size_t> robots = run_->arcosRobots();
  const Environment& environment = run_->run.environment();
  if (robots.empty()) {
    options_.arcos->log("world " + environment.world().name +
                        " has no robots for ARCOS programs: " + whyNoneIsForArcos(options_));
  }
  const std::vector<int> ports = arcos_->ports();
  if (options_.arcos->isFactory() && !ports.empty()) {
    const std::size_t most = robots.size() + options_.arcos->factory_most - 1;
    options_.arcos->log("up to " + std::to_string(most) + " robots, one for each ARCOS program on " +
                        withPort(options_.arcos->listen, ports.front()));
    return;
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const RobotInfo& robot = environment.fleet().robots[robots[i]].info;
    options_.arcos->log("robot " + robot.name + " (" + robot.type->model + ") for ARCOS programs on " +
                        withPort(options_.arcos->listen, ports[i]));
  }
}

void WorldRun::addRobots() {
  const std::size_t before = run_->networked.size();
  run_->addRobots(options_);
  if (arcos_ && options_.arcos->isFactory()) arcos_->addRobots(run_->arcosRobots());
  if (live_ && run_->networked.size() != before) live_->addRobots(run_->run, whyNotDriven());
}

void WorldRun::beginLive() {
  if (live_) live_->begin(run_->run, run_->run_info.run_id, run_->run_info.seed, whyNotDriven());
}

std::vector<std::string> WorldRun::whyNotDriven() const {
  std::vector<std::string> why_not_driven;
  for (std::size_t i = 0; i < run_->networked.size(); ++i) {
    why_not_driven.emplace_back(run_->is_arcos[i]    ? "an ARCOS program drives this robot"
                                : run_->networked[i] ? "another process drives this robot; use its remote port, and "
                                                       "'robosim remote'"
                                                     : "");
  }
  return why_not_driven;
}

void WorldRun::poll(RunControl& control) {
  if (arcos_) {
    arcos_->poll();
    loadRequestedMap();
  }
  if (!live_) return;
  requestPictures(pictured_);  // of clients that have subscribed since the last call
  const RecordingStatus status = recording();
  live_->poll(control,
              {status.state != RecordingStatus::State::none, status.state == RecordingStatus::State::on,
               [this](bool on) { setRecording(on); }},
              isOver(), [this](const Intervention& change) {
                if (isOver()) return std::string("the run is over, and its result stands; load the next one");
                return environment().apply(change);
              });
}

void WorldRun::requestPictures(const std::vector<std::uint8_t>& robots) {
  pictured_ = robots;
  std::vector<std::uint8_t> all = robots;
  if (live_ && run_->has_cameras) {
    all.resize(environment().robotCount());
    all = either(std::move(all), live_->pictured());
  }
  run_->requestPictures(std::move(all));
}

void WorldRun::decide() {
  if (arcos_) arcos_->decide();
  run_->run.decide();
}

void WorldRun::stepped(std::size_t late) {
  if (run_->late) *run_->late += late;
  run_->run.observe([&] { run_->outputs.observe(run_->run.environment()); });
  run_->reportRecording();
  if (arcos_) arcos_->stepped();
  if (live_) live_->stepped();
}

bool WorldRun::isOver() const { return run_->run.isOver() || options_.of_run.timeIsUp(run_->run.environment().time()); }

RecordingStatus WorldRun::recording() const {
  const RunRecording* recording = run_->outputs.recording();
  if (!recording) return {};
  return {recording->isOn() ? RecordingStatus::State::on : RecordingStatus::State::off,
          recording->file().filename().string(), recording->failure()};
}

void WorldRun::setRecording(bool on) {
  if (on && run_->is_finished) throw ConfigError("the run is over, and cannot be recorded; load the next one");
  try {
    if (on) run_->run.takePictures(std::vector<std::uint8_t>(environment().robotCount(), 1));  // of its first step
    run_->outputs.setRecording(on, run_->run);
  } catch (const RecordingError& error) {  // the run continues without this recording
    throw ConfigError(error.what());
  }
}

void WorldRun::ends(const RunReport& report) {
  run_->report = report;
  had_all_robots_ = had_all_robots_ && report.hasAllRobots();
  is_trusted_ = is_trusted_ && report.isTrusted();
  if (isOver()) finish(endedByItself());
}

std::unique_ptr<PreparedRun> WorldRun::prepare(const WorldSource& source) const {
  return prepareFrom([&] { return source; });
}

std::unique_ptr<WorldRun::Prepared> WorldRun::prepareFrom(const std::function<WorldSource()>& read) const {
  if (has_next_->exchange(true)) throw ConfigError("another world is being loaded; try again");
  auto next = std::make_unique<Prepared>(has_next_);
  try {
    next->run = load(read(), number_ + 1);
    return next;
    // Errors of the next run, after which the current run continues.
  } catch (const RecordingError& error) {
    throw ConfigError(error.what());
  } catch (const ControllerError& error) {
    throw ConfigError(error.what());
  } catch (const ObserverError& error) {
    throw ConfigError(error.what());
  }
}

/// Programs of ARCOS have no passwords: they may load what lies beside the map in use, and the maps of RoboSim.
void WorldRun::loadRequestedMap() {
  if (of_program_.valid()) return;
  const auto name = arcos_->takeMapRequest();
  if (!name) return;
  std::filesystem::path file = std::filesystem::path(run_->arguments.world).parent_path() / *name;
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) {
    const auto found = findDataFile("maps/" + *name);
    if (!found) {
      return arcos_->refuseMap("there is no such file beside the map in use, nor among RoboSim's maps");
    }
    file = *found;
  }
  options_.arcos->log("an ARCOS program loads the map " + file.string() +
                      "; the current run continues until it is built");
  of_program_ = std::async(std::launch::async, [this, file]() -> std::unique_ptr<PreparedRun> {
    RunArguments arguments = options_.of_run;
    arguments.world = file.string();
    auto next = prepareFrom([&] {
      requireKind(file, kWorldKinds);
      return readRunSource(arguments);
    });
    next->keeps_programs = true;
    return next;
  });
}

std::unique_ptr<PreparedRun> WorldRun::takeRequestedRun() {
  if (!of_program_.valid() || of_program_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return nullptr;
  try {
    auto next = of_program_.get();
    makeReady(*next);
    return next;
  } catch (const std::exception& error) {  // the current run continues
    arcos_->refuseMap(error.what());
    return nullptr;
  }
}

void WorldRun::makeReady(PreparedRun& next) const {
  auto& prepared = static_cast<Prepared&>(next);
  prepared.arcos = makeArcosServer(*prepared.run);
}

void WorldRun::replace(std::unique_ptr<PreparedRun> next) {
  auto& prepared = static_cast<Prepared&>(*next);
  run_->finish(prepared.keeps_programs ? EndedBy::arcos_program : EndedBy::control_panel);
  if (prepared.keeps_programs) prepared.arcos->takePrograms(*arcos_);
  arcos_ = std::move(prepared.arcos);  // the previous one uses the run that is replaced
  const auto previous = std::exchange(run_, std::move(prepared.run));
  pictured_.clear();
  beginLive();
  run_->start = std::chrono::steady_clock::now();
  ++number_;
  logArcosPorts();
}

EndedBy WorldRun::endedByItself() const { return robosim::endedByItself(run_->run); }

void WorldRun::finish(EndedBy ended_by) { run_->finish(ended_by); }

void WorldRun::keep() { run_->outputs.keep(run_->run.environment()); }

std::shared_ptr<WorldRun::OneRun> WorldRun::load(WorldSource source, int number) const {
  RunArguments of_this_run = options_.of_run;
  of_this_run.world = source.file;
  auto& seed = of_this_run.run.environment.seed;
  source.seed = seed = source.seed.value_or(seed);
  of_this_run.record = numbered(of_this_run.record, number);
  of_this_run.picture = numbered(of_this_run.picture, number);
  RunOptions& run = of_this_run.run;
  run.is_added_elsewhere = [options = options_](const FleetRobot& robot) {
    return isAddedForArcos(robot, options) || isNetworked(robot, options);
  };
  run.check_added = [options = options_, fault = whyNoAdditions(of_this_run)](const FleetRobot& robot) {
    if (!fault.empty() || !isDrivenByArcos(robot, options) || isAddedForArcos(robot, options)) return fault;
    return std::string(
        "robots for ARCOS programs can be added with --arcos-factory only, where they share a port; "
        "name a controller");
  };
  // A robot that another process drives needs no sensors for a controller of this one.
  const auto is_elsewhere = [this](const FleetRobot& robot, std::size_t) {
    return isDrivenByArcos(robot, options_) || isNetworked(robot, options_);
  };
  LoadedWorld world = loadWorldToRun(source, of_this_run.run.controller, is_elsewhere);
  if (options_.arcos && options_.arcos->isFactory()) requireArcosType(world.fleet, *options_.arcos);
  return std::make_shared<OneRun>(std::move(world), source, options_, std::move(of_this_run));
}

}  // namespace robosim
