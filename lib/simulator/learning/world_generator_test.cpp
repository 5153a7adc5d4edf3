#include "learning/world_generator.h"

#include <set>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/random.h"
#include "environment/model.h"
#include "learning/environment_batch.h"
#include "robots/world_source.h"
#include "world/generation/generators.h"
#include "world/world_file.h"

namespace robosim {
namespace {

WorldGenerator mazesOf(const std::string& type, double cell_m = 1.5) {
  MazeOptions maze;
  maze.columns = maze.rows = 4;
  maze.cell_m = cell_m;
  TeamOptions team;
  team.robots = 2;
  team.models = {type};
  return {[maze](std::uint64_t seed) { return generateMaze(maze, seed); }, team, "maze"};
}

TEST(WorldGenerator, MakesTheWorldsThatWorldFilesOfTheSameSeedContain) {
  const WorldGenerator make = mazesOf("pioneer3dx");
  std::set<std::uint64_t> different;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    LoadedWorld made = make(seed);
    LoadedWorld written = loadWorld(completeWorldSource(toXml(made.world), "maze.xml"), {});
    const std::uint64_t digest = digestOf({std::move(made.world), std::move(made.fleet)});
    EXPECT_EQ(digest, digestOf({std::move(written.world), std::move(written.fleet)})) << seed;
    different.insert(digest);
  }
  EXPECT_EQ(different.size(), 20u);
}

TEST(WorldGenerator, ReportsRobotsThatDoNotExist) {
  try {
    mazesOf("unicycle");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 59), "maze.xml: robot 'Robot1': there is no robot type 'unicycle'");
  }
}

/// All observations and rewards of 300 steps with random actions, in mazes of robots with many sensors and their
/// errors.
std::vector<float> observedIn(EnvironmentBatch& batch) {
  const std::size_t agents = batch.options().environments * batch.agentCount();
  std::vector<float> actions(2 * agents), observations(agents * batch.observationSize()), all;
  std::vector<double> rewards(agents);
  std::vector<std::uint8_t> terminated(batch.options().environments), truncated(batch.options().environments);
  batch.reset(observations);
  Rng rng(1);
  for (int step = 0; step < 300; ++step) {
    for (auto& action : actions) action = static_cast<float>(rng.uniform(-0.4, 1));
    batch.step(actions, {observations, rewards, terminated, truncated});
    all.insert(all.end(), observations.begin(), observations.end());
    all.insert(all.end(), rewards.begin(), rewards.end());
  }
  return all;
}

/// Measurement of a robot's first sensor of a kind, and what it is before the first step.
std::pair<Measurement, Measurement> measuredBy(const Environment& environment, std::size_t robot, SensorKind kind) {
  const auto& sensors = environment.fleet().robots[robot].model->sensors;
  for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
    if (sensors[slot]->info().kind == kind)
      return {environment.state().readings[robot].measurements[slot], sensors[slot]->blank()};
  }
  throw std::logic_error("there is no such sensor");
}

TEST(EnvironmentBatch, ObservesTheSameWhetherUnreadSensorsAreComputed) {
  for (const auto& observations :
       std::vector<std::vector<std::string>>{{"odometry"}, {"sonar", "stalled"}, {"laser"}}) {
    for (const bool has_others : {false, true}) {
      BatchOptions options;
      options.environments = 3;
      options.agents = 1;
      options.observations = observations;
      options.reward.heat = 0.5;
      options.steps_max = 120;
      const EnvironmentBatch::MakeOthers others =
          has_others ? [](Environment&, std::size_t) { return std::unique_ptr<OtherRobots>(); }
                     : EnvironmentBatch::MakeOthers();
      EnvironmentBatch few(mazesOf("pioneer3dx_polaroid"), options, others);
      options.has_digests = true;  // of all sensors
      EnvironmentBatch every(mazesOf("pioneer3dx_polaroid"), options, others);
      EXPECT_EQ(observedIn(few), observedIn(every));

      const auto is_computed = [&](std::size_t robot, SensorKind kind) {
        const auto [now, blank] = measuredBy(few.environment(0), robot, kind);
        const bool is_same = now == measuredBy(every.environment(0), robot, kind).first;
        EXPECT_NE(is_same, now == blank) << nameOf(kind);
        return is_same;
      };
      EXPECT_EQ(is_computed(0, SensorKind::laser), observations.front() == "laser");
      EXPECT_EQ(is_computed(0, SensorKind::sonar), observations.front() == "sonar");
      EXPECT_EQ(is_computed(1, SensorKind::sonar), has_others) << "controllers may read every sensor of their robots";
    }
  }
}

/// Results of a batch with random actions whose episodes are in mazes of their own.
struct MazeRun {
  std::vector<float> observations;         ///< of all steps
  std::vector<std::uint64_t> world_seeds;  ///< of all steps and environments

  MazeRun(int threads, std::uint32_t steps_max) {
    constexpr std::size_t kEnvironments = 9, kAgents = 2;
    BatchOptions options;
    options.environments = kEnvironments;
    options.observations = {"sonar", "pose"};
    options.steps_max = steps_max;
    options.threads = threads;
    EnvironmentBatch batch(mazesOf("scout"), options);
    std::vector<float> observed(kEnvironments * kAgents * batch.observationSize()),
        actions(kEnvironments * kAgents * 2);
    std::vector<double> rewards(kEnvironments * kAgents);
    std::vector<std::uint8_t> terminated(kEnvironments), truncated(kEnvironments);
    batch.reset(observed);
    Rng rng(3);
    for (int step = 0; step < 40; ++step) {
      observations.insert(observations.end(), observed.begin(), observed.end());
      for (std::size_t i = 0; i < kEnvironments; ++i) world_seeds.push_back(batch.worldSeed(i));
      for (auto& action : actions) action = static_cast<float>(rng.uniform(-1, 1));
      batch.step(actions, {observed, rewards, terminated, truncated});
    }
  }
};

TEST(GeneratedEpisodes, AreTheSameForAnyNumberOfThreads) {
  const MazeRun one(1, 12);
  for (const int threads : {2, 5}) {
    const MazeRun other(threads, 12);
    EXPECT_EQ(other.observations, one.observations) << threads << " threads";
    EXPECT_EQ(other.world_seeds, one.world_seeds) << threads << " threads";
  }
}

TEST(GeneratedEpisodes, EachHaveAnotherWorld) {
  const MazeRun run(1, 12);  // episodes begin at steps 0, 13, 26, 39
  EXPECT_EQ(std::set<std::uint64_t>(run.world_seeds.begin(), run.world_seeds.end()).size(), 9u * 4u);
}

BatchOptions optionsOf(std::size_t environments) {
  BatchOptions options;
  options.environments = environments;
  options.observations = {"sonar"};
  return options;
}

TEST(GeneratedEpisodes, DependOnTheSeedOfTheEnvironmentAndTheirNumber) {
  EnvironmentBatch batch(mazesOf("scout"), optionsOf(2));
  std::vector<float> observed(2 * 2 * batch.observationSize());
  EXPECT_EQ(batch.worldSeed(0), 0u);
  batch.reset(observed);
  const std::uint64_t first = batch.worldSeed(0), of_second = batch.worldSeed(1);
  const std::vector<float> of_first = observed;
  EXPECT_EQ(digestOf(*batch.environment(0).model()), [&] {
    LoadedWorld world = mazesOf("scout")(first);
    return digestOf({std::move(world.world), std::move(world.fleet)});
  }());
  batch.reset(observed);
  EXPECT_NE(batch.worldSeed(0), first);
  EXPECT_NE(observed, of_first);
  batch.setSeed(1, 1);  // that of environment 0
  batch.setSeed(0, 2);
  batch.reset(observed);
  EXPECT_EQ(batch.worldSeed(1), first);
  EXPECT_EQ(batch.worldSeed(0), of_second);
}

TEST(GeneratedEpisodes, ThatCannotBeMadeAreReportedAndTheNextOneFollows) {
  const WorldGenerator mazes = mazesOf("scout");
  int made = 0;
  const auto make = [&](std::uint64_t seed) {
    if (++made == 2) throw ConfigError("no place");
    return mazes(seed);
  };
  EnvironmentBatch batch(make, optionsOf(1));
  std::vector<float> observed(2 * batch.observationSize());
  EXPECT_THROW(batch.reset(observed), ConfigError);
  batch.reset(observed);
  EXPECT_EQ(made, 3);
  EXPECT_NE(batch.worldSeed(0), 0u);
}

/// The heat sensor follows the sonars of a Scout, and the laser of a Pioneer.
TEST(GeneratedEpisodes, RefuseRobotsThatMeasureTheSameByOtherSensors) {
  const WorldGenerator scouts = mazesOf("scout"), pioneers = mazesOf("pioneer3dx");
  int made = 0;
  EnvironmentBatch batch([&](std::uint64_t seed) { return ++made == 1 ? scouts(seed) : pioneers(seed); },
                         [] {
                           BatchOptions options = optionsOf(1);
                           options.observations = {"heat", "odometry"};
                           return options;
                         }());
  std::vector<float> observed(2 * batch.observationSize());
  try {
    batch.reset(observed);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "world 'maze': robot 'Robot1' observes other numbers than agent 1 of the first world, or by other "
                 "sensors; use the same robot types in all worlds");
  }
}

}  // namespace
}  // namespace robosim
