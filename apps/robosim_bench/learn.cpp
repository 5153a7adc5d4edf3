#include <filesystem>
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/random.h"
#include "base/text_table.h"
#include "learning/environment_batch.h"
#include "learning/world_generator.h"
#include "robosim/arguments.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/process.h"
#include "robosim_bench/rounds.h"
#include "robosim_bench/workloads.h"
#include "run/local_run.h"
#include "world/generation/generators.h"

namespace robosim {
namespace {

constexpr std::size_t kRobots = 1000;    ///< of the run that batches are compared with, and agents of a batch
constexpr std::uint32_t kEpisode = 500;  ///< steps of an episode
constexpr std::uint32_t kMazeEpisodes[] = {500, 5000};
constexpr const char* kWorkloadsOfLearning[] = {"sonar", "laser"};
constexpr std::size_t kTeams[] = {1, 10, 100};
constexpr std::uint64_t kWorlds = 8;  ///< of a batch

/// A batch with its arrays, and random actions that it takes in turn.
class BatchRun {
 public:
  /// @param worlds std::vector<LoadedWorld>, or EnvironmentBatch::MakeWorld
  template <typename Worlds>
  BatchRun(Worlds worlds, const BatchOptions& options)
      : batch_(std::move(worlds), options), agents_(options.environments * batch_.agentCount()) {
    observations_.resize(agents_ * batch_.observationSize());
    rewards_.resize(agents_);
    terminated_.resize(options.environments);
    truncated_.resize(options.environments);
    Rng rng(1);
    for (auto& actions : actions_) {
      for (std::size_t i = 0; i < 2 * agents_; ++i) {
        actions.push_back(static_cast<float>(i % 2 ? rng.uniform(-0.5, 0.5) : rng.uniform(0.2, 1)));
      }
    }
    batch_.reset(observations_);
  }

  /// @return number of agents
  double step() {
    batch_.step(actions_[steps_++ / 8 % actions_.size()], {observations_, rewards_, terminated_, truncated_});
    return static_cast<double>(agents_);
  }

 private:
  EnvironmentBatch batch_;
  std::size_t agents_;
  std::vector<float> observations_;
  std::vector<double> rewards_;
  std::vector<std::uint8_t> terminated_, truncated_;
  std::array<std::vector<float>, 16> actions_;
  std::size_t steps_ = 0;
};

nlohmann::json compare(const Workload& workload, std::size_t team, double min_s) {
  LocalRun run(makeWorldToRun(workload, kRobots, 1), RunOptions{});
  std::vector<LoadedWorld> worlds;
  for (std::uint64_t seed = 1; seed <= kWorlds; ++seed) worlds.push_back(makeWorldToRun(workload, team, seed));
  BatchOptions options;
  options.environments = kRobots / team;
  options.observations = {workload.name == std::string("laser") ? "laser" : "sonar", "odometry"};
  options.steps_max = kEpisode;
  BatchRun batch(std::move(worlds), options);
  for (int i = 0; i < 20; ++i) {
    run.step();
    batch.step();
  }
  const Contender contenders[] = {{.work =
                                       [&run] {
                                         run.step();
                                         return static_cast<double>(run.environment().robotCount());
                                       }},
                                  {.work = [&batch] { return batch.step(); }}};
  const std::vector<Cost> costs = measureAlternately(contenders, min_s);
  return {{"workload", workload.name},
          {"robots_per_world", team},
          {"worlds", options.environments},
          {"robot_steps_per_s", 1 / costs[0].cpu_s},
          {"agent_steps_per_s", 1 / costs[1].cpu_s},
          {"ratio", costs[0].cpu_s / costs[1].cpu_s}};
}

WorldGenerator mazes() {
  MazeOptions maze;
  maze.columns = maze.rows = 6;
  TeamOptions team;
  team.robots = 1;
  team.models = {"pioneer3dx"};
  return {[maze](std::uint64_t seed) { return generateMaze(maze, seed); }, team, "maze"};
}

std::vector<LoadedWorld> hundredMazes() {
  const WorldGenerator make = mazes();
  std::vector<LoadedWorld> worlds;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) worlds.push_back(make(seed));
  return worlds;
}

/// A new maze for each episode, beside episodes in a hundred mazes.
nlohmann::json compareGenerated(std::uint32_t episode, double min_s) {
  BatchOptions options;
  options.environments = kRobots;
  options.steps_max = episode;
  BatchRun fixed(hundredMazes(), options), generated(mazes(), options);
  options.has_random_starts = false;
  BatchRun at_its_start(mazes(), options);
  const Contender contenders[] = {{.work = [&fixed] { return fixed.step(); }},
                                  {.work = [&generated] { return generated.step(); }},
                                  {.work = [&at_its_start] { return at_its_start.step(); }}};
  const std::vector<Cost> costs = measureAlternately(contenders, min_s);
  return {{"episode", episode},
          {"fixed_steps_per_s", 1 / costs[0].cpu_s},
          {"generated_steps_per_s", 1 / costs[1].cpu_s},
          {"generated_start_steps_per_s", 1 / costs[2].cpu_s}};
}

nlohmann::json measureMemory(std::size_t environments) {
  const Memory before = Memory::now();
  BatchOptions options;
  options.environments = environments;
  BatchRun batch(hundredMazes(), options);
  for (int i = 0; i < 20; ++i) batch.step();
  return {{"worlds", environments}, {"held_mb", Memory::now().resident_mb - before.resident_mb}};
}

/// Writes the worlds of all batches, for learn.py.
void writeWorlds(const std::filesystem::path& folder) {
  for (const char* name : kWorkloadsOfLearning) {
    for (const std::size_t team : kTeams) {
      for (std::uint64_t seed = 1; seed <= kWorlds; ++seed) {
        const auto of_one = folder / std::to_string(team) / std::to_string(seed);
        writeWorld(of_one, workloadNamed(name), team, seed);
      }
    }
  }
}

struct LearnArguments {
  std::string worlds;
  double min_s = 3;
  bool as_json = false;
};

void benchLearn(const LearnArguments& arguments) {
  if (!arguments.worlds.empty()) return writeWorlds(arguments.worlds);
  auto figures = nlohmann::json::object();
  for (const char* name : kWorkloadsOfLearning) {
    for (const std::size_t team : kTeams) {
      figures["speed"].push_back(
          runInChildProcess([&] { return compare(workloadNamed(name), team, arguments.min_s); }));
    }
  }
  for (const std::uint32_t episode : kMazeEpisodes) {
    figures["mazes"].push_back(runInChildProcess([&] { return compareGenerated(episode, arguments.min_s); }));
  }
  figures["memory"] = runInChildProcess([] { return measureMemory(4096); });
  if (arguments.as_json) {
    std::cout << figures.dump(2) << '\n';
    return;
  }
  Rows rows{{"workload", "robots per world", "worlds", "agent-steps/s", "robot-steps/s of one run", "ratio"}};
  for (const auto& of : figures["speed"]) {
    rows.push_back({of["workload"].get<std::string>(), withCommas(of["robots_per_world"]), withCommas(of["worlds"]),
                    withCommas(static_cast<std::uint64_t>(of["agent_steps_per_s"])),
                    withCommas(static_cast<std::uint64_t>(of["robot_steps_per_s"])), fixed(of["ratio"], 2)});
  }
  Rows of_mazes{{"steps of an episode in a maze", "100 mazes", "a new maze for each episode", "and its own start"}};
  for (const auto& of : figures["mazes"]) {
    const auto speed = [&of](const char* name) { return withCommas(static_cast<std::uint64_t>(of[name])); };
    of_mazes.push_back({withCommas(of["episode"]), speed("fixed_steps_per_s"), speed("generated_steps_per_s"),
                        speed("generated_start_steps_per_s")});
  }
  std::cout << table(rows) << table(of_mazes) << "Agent-steps per second of processor time, one thread; episodes of "
            << kEpisode << " steps, including resets.\n"
            << withCommas(figures["memory"]["worlds"]) << " worlds of 100 generated mazes hold "
            << fixed(figures["memory"]["held_mb"], 0) << " MB.\n";
}

}  // namespace

void addLearnBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand("learn", "Measure batches of environments for learning, beside a run");
  auto a = std::make_shared<LearnArguments>();
  command->add_option("--min-time", a->min_s, "working time of each measurement; 0.1 to 100")
      ->check(numberIn(0.1, 100))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_flag("--json", a->as_json, "print a JSON object");
  command
      ->add_option("--write-worlds", a->worlds, "write the worlds into this folder, for learn.py, and measure nothing")
      ->type_name("FOLDER");
  command->callback([a] { benchLearn(*a); });
}

}  // namespace robosim
