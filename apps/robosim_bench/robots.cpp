#include "robosim_bench/robots.h"

#include "base/temporary_directory.h"
#include "robosim_bench/process.h"
#include "run/local_run.h"

namespace robosim {
namespace {

/// A run after its warm-up steps, in which caches are filled, arrays allocated and robots accelerated.
class WarmRun {
 public:
  /// @param make creates the world
  template <typename Make>
  WarmRun(const Make& make, int threads, std::uint64_t seed) {
    const Clocks start = Clocks::now();
    RunOptions options{.environment = {.seed = seed, .period_s = 0.1, .threads = threads}, .controller = ""};
    LoadedWorld world = make();
    options.takes_pictures = needPictures(world.fleet, options.controller);  // as `robosim run` without a recording
    run_ = std::make_unique<LocalRun>(std::move(world), options);
    const Clocks ready = Clocks::now();
    making_ = {ready.wall_s - start.wall_s, ready.cpu_s - start.cpu_s};
    constexpr int kWarmUpSteps = 20;
    for (int i = 0; i < kWarmUpSteps; ++i) run_->step();
    digest_ = run_->environment().digest();
  }

  /// Takes one step per call; the unit is a robot-step.
  Contender steps() const {
    return {.work = [run = run_.get()] {
      run->step();
      return static_cast<double>(run->environment().robotCount());
    }};
  }
  const Cost& making() const { return making_; }  ///< cost of creating the run up to its first step
  const std::string& digest() const { return digest_; }

 private:
  std::unique_ptr<LocalRun> run_;
  Cost making_;
  std::string digest_;
};

WarmRun warmRun(const RobotLoad& load, std::uint64_t seed) {
  return {[&] { return makeWorldToRun(*load.workload, load.robots, seed); }, load.threads, seed};
}

}  // namespace

RobotFigures benchRobots(const RobotLoad& load, std::uint64_t seed, double min_s) {
  return runInChildProcess([&]() -> RobotFigures {
    const WarmRun run = warmRun(load, seed);
    const Contender steps = run.steps();
    const Cost cost = measureAlternately({&steps, 1}, min_s).front();
    return {.workload = load.workload->name,
            .rays = load.workload->rays,
            .robots = load.robots,
            .threads = load.threads,
            .robot_step = cost,
            .peak_rss_mb = Memory::now().peak_mb,
            .make_s = run.making().wall_s,
            .digest = run.digest()};
  });
}

std::vector<Cost> compareRobots(const std::vector<RobotLoad>& loads, std::uint64_t seed, double min_s) {
  return runInChildProcess([&] {
    std::vector<WarmRun> runs;
    std::vector<Contender> contenders;
    for (const auto& load : loads) {
      runs.push_back(warmRun(load, seed));
      contenders.push_back(runs.back().steps());
    }
    return measureAlternately(contenders, min_s);
  });
}

LoadingFigures benchLoading(const Workload& workload, std::size_t robots, std::uint64_t seed) {
  const TemporaryDirectory folder;
  // Written by another process, so that the memory used for it does not count.
  const auto file = runInChildProcess([&] { return writeWorld(folder.path(), workload, robots, seed).string(); });
  return runInChildProcess([&]() -> LoadingFigures {
    const Memory before = Memory::now();
    const WarmRun run([&] { return loadWorldToRun(file.get<std::string>(), ""); }, 1, seed);
    return {.load = run.making(), .rss_growth_mb = Memory::now().resident_mb - before.resident_mb};
  });
}

}  // namespace robosim
