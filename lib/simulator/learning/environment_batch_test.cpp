#include "learning/environment_batch.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

/// A square of 4 m with gold at (1.5, 0) and a robot at (0, 0) that heads towards it. The disc of 0.25 m wins within
/// 0.5 m of the gold's disc of 0.2 m: from x = 1.5 - 0.2 - 0.25 - 0.5 = 0.55.
LoadedWorld worldWithGold(int robots = 1) {
  LoadedWorld made{emptyWorld(2), {}};
  addGold(made.world, 1.5, 0);
  for (int i = 0; i < robots; ++i) addDisc(made.world, made.fleet, "r" + std::to_string(i), {0, -0.8 * i, 0});
  return made;
}

std::vector<LoadedWorld> worldsOf(LoadedWorld world) {
  std::vector<LoadedWorld> worlds;
  worlds.push_back(std::move(world));
  return worlds;
}

BatchOptions poseOptions(std::size_t environments, bool has_random_starts = false) {
  BatchOptions options;
  options.environments = environments;
  options.observations = {"pose"};
  options.has_random_starts = has_random_starts;
  return options;
}

struct Arrays {
  std::vector<float> observations;
  std::vector<double> rewards;
  std::vector<std::uint8_t> terminated, truncated;
  explicit Arrays(const EnvironmentBatch& batch)
      : observations(batch.options().environments * batch.agentCount() * batch.observationSize()),
        rewards(batch.options().environments * batch.agentCount()),
        terminated(batch.options().environments),
        truncated(batch.options().environments) {}
  BatchResults results() { return {observations, rewards, terminated, truncated}; }
};

TEST(EnvironmentBatch, ScalesActionsByTheRobotsLimits) {
  EnvironmentBatch batch(worldsOf(worldWithGold()), poseOptions(2));
  Arrays arrays(batch);
  batch.reset(arrays.observations);
  const std::vector<float> actions{0.5f, 0, 0, 0.5f};  // limits: 1 m/s, 2 rad/s; steps of 0.1 s
  batch.step(actions, arrays.results());
  EXPECT_EQ(arrays.observations, (std::vector<float>{0.05f, 0, 0, 0, 0, 0.1f}));
}

TEST(EnvironmentBatch, BeginsEpisodesWithTheChangesOfTheirEnvironment) {
  BatchOptions options = poseOptions(2);
  options.steps_max = 1;
  options.has_digests = true;
  EnvironmentBatch batch(worldsOf(worldWithGold()), options);
  Arrays arrays(batch);
  WorldObject crate;
  crate.name = "crate";
  crate.body = {Cube{0.5, 0.5}, {-1, -1, 0}, 0.5, 1};
  batch.setChanges(1, {PlaceBody{"r0", 1, 1, 0.5}, AddObject{crate}});
  batch.reset(arrays.observations);
  const std::vector<float> changed{0, 0, 0, 1, 1, 0.5f};
  EXPECT_EQ(arrays.observations, changed);
  EXPECT_EQ(batch.environment(0).objects().size(), 1u);
  EXPECT_EQ(batch.environment(1).objects().size(), 2u);
  EXPECT_EQ(batch.environment(1).state().interventions_applied, 0u);
  const std::vector<float> still(4, 0);
  const std::string digest = batch.environment(1).digest();
  batch.step(still, arrays.results());
  EXPECT_EQ(arrays.truncated[1], 1);
  batch.step(still, arrays.results());  // begins the next episodes
  EXPECT_EQ(arrays.observations, changed);
  EXPECT_EQ(batch.environment(1).objects().size(), 2u);
  EXPECT_EQ(batch.environment(1).digest(), digest) << "the same start";
  batch.setChanges(1, {});
  batch.reset(arrays.observations);
  EXPECT_EQ(arrays.observations, std::vector<float>(6, 0));
  EXPECT_EQ(batch.environment(1).objects().size(), 1u);
}

TEST(EnvironmentBatch, RefusesAnImpossibleChangeAtTheBeginningOfAnEpisode) {
  EnvironmentBatch batch(worldsOf(worldWithGold()), poseOptions(2));
  Arrays arrays(batch);
  batch.setChanges(1, {PlaceBody{"r0", 3, 0}});
  try {
    batch.reset(arrays.observations);
    FAIL() << "not refused";
  } catch (const ConfigError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("environment 1: an episode cannot begin with <place name=\"r0\" x=\"3\" y=\"0\"/>: 'r0' would "
                        "not be on the surface"),
              std::string::npos)
        << text;
  }
  batch.setChanges(1, {});
  batch.reset(arrays.observations);
  EXPECT_EQ(arrays.observations, std::vector<float>(6, 0));
  EXPECT_THROW(batch.setChanges(0, {EndRun{"over"}}), ConfigError);
}

TEST(EnvironmentBatch, ReturnsTheFinalObservationAndResetsInTheNextStep) {
  BatchOptions options = poseOptions(1);
  options.reward.win = 10;
  EnvironmentBatch batch(worldsOf(worldWithGold()), options);
  Arrays arrays(batch);
  batch.reset(arrays.observations);
  const std::vector<float> ahead{1, 0};
  for (int i = 0; i < 5; ++i) {
    batch.step(ahead, arrays.results());
    EXPECT_EQ(arrays.rewards[0], 0);
    EXPECT_EQ(arrays.terminated[0], 0);
  }
  batch.step(ahead, arrays.results());  // to x = 0.6, within the win distance
  EXPECT_NEAR(arrays.observations[0], 0.6, 1e-6);
  EXPECT_EQ(arrays.rewards[0], 10);
  EXPECT_EQ(arrays.terminated[0], 1);
  EXPECT_EQ(arrays.truncated[0], 0);
  batch.step(ahead, arrays.results());  // ignores the action
  EXPECT_EQ(arrays.observations[0], 0);
  EXPECT_EQ(arrays.rewards[0], 0);
  EXPECT_EQ(arrays.terminated[0], 0);
}

TEST(EnvironmentBatch, TruncatesEpisodesAfterTheGivenNumberOfSteps) {
  BatchOptions options = poseOptions(1);
  options.steps_max = 3;
  options.reward = {.win = 0, .step = -1};
  EnvironmentBatch batch(worldsOf(worldWithGold()), options);
  Arrays arrays(batch);
  batch.reset(arrays.observations);
  std::vector<int> truncated;
  std::vector<double> rewards;
  for (int i = 0; i < 8; ++i) {
    batch.step(std::vector<float>{0, 0}, arrays.results());
    truncated.push_back(arrays.truncated[0]);
    rewards.push_back(arrays.rewards[0]);
  }
  EXPECT_EQ(truncated, (std::vector<int>{0, 0, 1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(rewards, (std::vector<double>{-1, -1, -1, 0, -1, -1, -1, 0}));
}

TEST(EnvironmentBatch, GivesTheSameBatchForAnyNumberOfThreads) {
  std::vector<float> of_one_thread;
  for (const int threads : {1, 2, 5}) {
    BatchOptions options = poseOptions(23, true);
    options.observations = {"odometry", "pose", "stalled"};
    options.steps_max = 17;
    options.threads = threads;
    EnvironmentBatch batch(worldsOf(worldWithGold(3)), options);
    Arrays arrays(batch);
    batch.reset(arrays.observations);
    Rng rng(7);
    std::vector<float> actions(23 * 3 * 2), all;
    for (int step = 0; step < 60; ++step) {
      for (auto& action : actions) action = static_cast<float>(rng.uniform(-1, 1));
      batch.step(actions, arrays.results());
      all.insert(all.end(), arrays.observations.begin(), arrays.observations.end());
    }
    if (threads == 1) of_one_thread = all;
    EXPECT_EQ(all, of_one_thread) << threads << " threads";
  }
}

TEST(EnvironmentBatch, ComputesDigestsOnRequestOnly) {
  const auto batch_with = [](bool has_digests) {
    BatchOptions options = poseOptions(1);
    options.has_digests = has_digests;
    auto batch = std::make_unique<EnvironmentBatch>(worldsOf(worldWithGold()), options);
    Arrays arrays(*batch);
    batch->reset(arrays.observations);
    for (int i = 0; i < 3; ++i) batch->step(std::vector<float>{1, 0}, arrays.results());
    return batch;
  };
  const auto with = batch_with(true), without = batch_with(false);
  State same = with->environment(0).state();
  same.digest.reset();
  EXPECT_EQ(without->environment(0).state(), same);
  EXPECT_EQ(with->environment(0).digest().size(), 16u);
  EXPECT_THROW(without->environment(0).digest(), std::invalid_argument);
}

TEST(EnvironmentBatch, StartsEpisodesAtRandomPosesThatDependOnTheSeed) {
  EnvironmentBatch batch(worldsOf(worldWithGold()), poseOptions(3, true));
  Arrays arrays(batch);
  batch.reset(arrays.observations);
  const auto first = arrays.observations;
  EXPECT_NE(first[0], first[3]);
  batch.reset(arrays.observations);
  EXPECT_NE(arrays.observations, first);
  batch.setSeed(1);
  batch.reset(arrays.observations);
  EXPECT_EQ(arrays.observations, first);
}

TEST(EnvironmentBatch, RefusesActionsThatAreNotFiniteAndChangesNothing) {
  EnvironmentBatch batch(worldsOf(worldWithGold(2)), poseOptions(2));
  Arrays arrays(batch);
  batch.reset(arrays.observations);
  std::vector<float> actions(8, 0.5f);
  actions[7] = std::numeric_limits<float>::quiet_NaN();
  try {
    batch.step(actions, arrays.results());
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "the action of agent 1 in environment 1 is not finite; actions are fractions in [-1, 1]");
  }
  EXPECT_EQ(batch.environment(0).time().step, 0u);
}

TEST(EnvironmentBatch, ReportsWhatARobotCanObserve) {
  BatchOptions options = poseOptions(1);
  options.observations = {"sonar"};
  try {
    EnvironmentBatch batch(worldsOf(worldWithGold()), options);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "robot 'r0' cannot observe 'sonar'; observations may be odometry, stalled, pose");
  }
}

}  // namespace
}  // namespace robosim
