#include "serving/world_run.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "control/controller_error.h"
#include "recording/recording_error.h"
#include "robots/world_source.h"
#include "run/local_run.h"
#include "server/run_info.h"

namespace robosim {
namespace {

/// Robots driven by other processes: all, if the environment waits for them; otherwise those without a controller.
std::vector<std::uint8_t> networkedRobots(const Fleet& fleet, const WorldRunOptions& options) {
  std::vector<std::uint8_t> networked;
  for (const auto& robot : fleet.robots) {
    const bool has_controller = !options.of_run.run.controller.empty() || !robot.controller.empty();
    networked.push_back(options.wait_for_robots || !has_controller);
  }
  return networked;
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
        networked(networkedRobots(world.fleet, options)),
        run(std::move(world), arguments.run, networked),
        run_info(run.environment(), source, arguments.run.environment.seed, networked),
        outputs(arguments, run.environment(), noteOf(source, run, arguments.run, networked)) {
    outputs.observe(run.environment());
    if (options.is_realtime) late = 0;
  }

  void finish(EndedBy ended_by) {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    outputs.finish(run, wall.count(), ended_by, late, report);
  }

  RunArguments arguments;
  std::vector<std::uint8_t> networked;
  LocalRun run;
  RunInfo run_info;
  RunOutputs outputs;
  RunReport report;
  std::optional<std::uint64_t> late;  ///< robot-steps whose command came too late
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

class WorldRun::Prepared final : public PreparedRun {
 public:
  explicit Prepared(std::shared_ptr<OneRun> r) : run(std::move(r)) {}
  std::shared_ptr<OneRun> run;
};

WorldRun::WorldRun(WorldRunOptions options) : options_(std::move(options)), run_(load(sourceOf(options_.of_run), 1)) {}

WorldRun::~WorldRun() = default;

Environment& WorldRun::environment() { return run_->run.environment(); }

std::shared_ptr<const RunInfo> WorldRun::runInfo() const { return {run_, &run_->run_info}; }

void WorldRun::decide() { run_->run.decide(); }

void WorldRun::stepped(std::size_t late) {
  if (run_->late) *run_->late += late;
  run_->run.noteOutcome();
  run_->outputs.observe(run_->run.environment());
}

bool WorldRun::isOver() const { return run_->run.isOver() || options_.of_run.timeIsUp(run_->run.environment().time()); }

void WorldRun::ends(const RunReport& report) {
  run_->report = report;
  had_all_robots_ = had_all_robots_ && report.hasAllRobots();
  is_trusted_ = is_trusted_ && report.isTrusted();
}

std::unique_ptr<PreparedRun> WorldRun::prepare(const WorldSource& source) const {
  try {
    return std::make_unique<Prepared>(load(source, number_ + 1));
    // Errors of the next run, after which the current run continues.
  } catch (const RecordingError& error) {
    throw ConfigError(error.what());
  } catch (const ControllerError& error) {
    throw ConfigError(error.what());
  } catch (const ObserverError& error) {
    throw ConfigError(error.what());
  }
}

void WorldRun::replace(std::unique_ptr<PreparedRun> next) {
  run_->finish(EndedBy::control_panel);
  run_ = static_cast<Prepared&>(*next).run;
  run_->start = std::chrono::steady_clock::now();
  ++number_;
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
  LoadedWorld world = loadWorldToRun(source, of_this_run.run.controller);
  return std::make_shared<OneRun>(std::move(world), source, options_, std::move(of_this_run));
}

}  // namespace robosim
