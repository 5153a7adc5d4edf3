#include "learning/environment_batch.h"

#include <algorithm>
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

TEST(EnvironmentBatch, WritesThePicturesOfRaycastCameras) {
  World world = emptyWorld(4);
  addGold(world, 2.2, 0);  // its near side is 2 m ahead
  for (const char* model : {"eye", "blind"}) {
    RobotPlacement& placement = world.robots.emplace_back();
    placement.name = placement.model = model;
    placement.world_from_robot = {0, model[0] == 'e' ? 0.0 : -3.0, 0};
  }
  const auto type = [](const std::string& name, const std::string& camera) {
    return std::pair{name, RobotTypeFile{name + ".xml", "<robot name=\"" + name +
                                                            R"(" help="Sees."><body radius_m="0.2" height_m="0.3"/>
      <limits speed_max_mps="1" accel_mps2="9" decel_mps2="9" turn_max_degps="90" turn_accel_degps2="900"/>
      <sensors><odometry/>)" + camera + "</sensors></robot>"}};
  };
  ErrorList errors;
  Fleet fleet = buildFleet(world, "eyes.xml",
                           {type("eye", R"(<camera model="raycast" layers="rgb depth" width_px="3" height_px="1"
                                            field_of_view_deg="90" z_m="0.25" rate_hz="5"/>)"),
                            type("blind", "")},
                           {}, errors);
  errors.throwIfAny();
  BatchOptions options;
  options.environments = 2;
  options.observations = {"odometry", "camera"};
  options.has_random_starts = false;
  EnvironmentBatch batch(worldsOf({std::move(world), std::move(fleet)}), options);
  ASSERT_EQ(batch.pictures().size(), 1u);
  EXPECT_EQ(batch.pictures()[0].name, "camera");
  EXPECT_EQ(batch.observationSize(), 5u) << "of odometry";
  Arrays arrays(batch);
  batch.reset(arrays.observations);
  std::vector<std::uint8_t> rgb(2 * 2 * 3 * 3, 1);
  std::vector<float> depth(2 * 2 * 3, 1);
  batch.writePictures(0, {rgb, depth, {}});
  EXPECT_EQ(depth[1], 2);
  EXPECT_EQ(std::vector(rgb.begin() + 3, rgb.begin() + 6), (std::vector<std::uint8_t>{128, 128, 128})) << "it glows";
  EXPECT_EQ(std::vector(depth.begin() + 3, depth.begin() + 6), (std::vector<float>{0, 0, 0})) << "of the blind robot";
  EXPECT_TRUE(std::equal(depth.begin(), depth.begin() + 6, depth.begin() + 6)) << "the other environment";
  batch.step(std::vector<float>(8), arrays.results());
  batch.writePictures(0, {rgb, depth, {}});
  EXPECT_EQ(depth, std::vector<float>(12)) << "a step without a picture";
  std::vector<std::uint32_t> identity(12);
  EXPECT_THROW(batch.writePictures(0, {rgb, depth, identity}), std::invalid_argument);
}

TEST(EnvironmentBatch, HasALateralSpeedInTheActionsOfOmnidirectionalAgents) {
  LoadedWorld world = worldWithGold();
  FleetRobot& robot = world.fleet.robots[0];
  robot.info.type.edit().drive.kind = DriveKind::omni;
  robot.info.type.edit().limits.lateral_max_mps = 0.8;
  EnvironmentBatch batch(worldsOf(std::move(world)), poseOptions(1));
  EXPECT_EQ(batch.actionSize(), 3u);
  Arrays arrays(batch);
  batch.reset(arrays.observations);
  batch.step(std::vector<float>{0.5f, 0, -0.5f}, arrays.results());
  EXPECT_EQ(arrays.observations, (std::vector<float>{0.05f, -0.04f, 0}));
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

TEST(EnvironmentBatch, StepsManyWorldsOfWhichSomeAreChangedAsEachAlone) {
  constexpr std::size_t kWorlds = 100, kChanged = 7;
  WorldObject crate;
  crate.name = "crate";
  crate.body = {Cube{0.2, 0.2}, {0.55, 0, 0}, 0.5, 1};  // between robot and gold
  const std::vector<Change> changes{AddObject{crate}};
  const auto options = [](std::size_t environments, int threads) {
    BatchOptions of = poseOptions(environments);
    of.steps_max = 12;
    of.threads = threads;
    return of;
  };
  const auto run = [&](EnvironmentBatch& batch, const auto& is_changed) {
    Arrays arrays(batch);
    for (std::size_t i = 0; i < batch.options().environments; ++i) {
      if (is_changed(i)) batch.setChanges(i, changes);
    }
    batch.reset(arrays.observations);
    std::vector<float> actions;
    for (std::size_t i = 0; i < batch.options().environments; ++i) actions.insert(actions.end(), {1, 0.2f});
    for (int i = 0; i < 20; ++i) batch.step(actions, arrays.results());  // beyond the end of the first episode
    return arrays.observations;
  };
  std::vector<std::vector<float>> alone;
  for (const bool is_changed : {false, true}) {
    EnvironmentBatch one(worldsOf(worldWithGold()), options(1, 1));
    alone.push_back(run(one, [&](std::size_t) { return is_changed; }));
  }
  ASSERT_NE(alone[0], alone[1]);
  for (const int threads : {1, 3}) {
    EnvironmentBatch batch(worldsOf(worldWithGold()), options(kWorlds, threads));
    const std::vector<float> all = run(batch, [](std::size_t i) { return i % kChanged == 0; });
    for (std::size_t i = 0; i < kWorlds; ++i) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(3 * i);
      EXPECT_EQ(std::vector(begin, begin + 3), alone[i % kChanged == 0 ? 1 : 0]) << i;
    }
  }
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

TEST(EnvironmentBatch, WritesStepsAndWhetherTheGoldIsFoundOnRequest) {
  BatchOptions options = poseOptions(2);
  EnvironmentBatch batch(worldsOf(worldWithGold()), options);
  Arrays arrays(batch);
  batch.reset(arrays.observations);
  std::vector<std::int64_t> steps(2);
  std::vector<std::uint8_t> gold_found(2);
  BatchResults results = arrays.results();
  results.steps = steps;
  results.gold_found = gold_found;
  const std::vector<float> actions{1, 0, 0, 0};  // the first robot wins at x = 0.6, after six steps
  for (int step = 1; step <= 6; ++step) {
    batch.step(actions, results);
    EXPECT_EQ(steps, (std::vector<std::int64_t>{step, step}));
    EXPECT_EQ(gold_found, (std::vector<std::uint8_t>{step == 6, 0}));
  }
  batch.step(actions, results);  // begins the next episode of the first
  EXPECT_EQ(steps, (std::vector<std::int64_t>{0, 7}));
  EXPECT_EQ(gold_found, (std::vector<std::uint8_t>{0, 0}));
  steps.resize(1);
  results.steps = steps;
  EXPECT_THROW(batch.step(actions, results), std::invalid_argument);
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
    options.observations = {"pose", "odometry"};  // all that the robot measures
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

TEST(EnvironmentBatch, ContinuesASavedEpisodeInAnotherBatch) {
  const BatchOptions options = poseOptions(2, true);
  EnvironmentBatch batch(worldsOf(worldWithGold()), options), other(worldsOf(worldWithGold()), options);
  Arrays arrays(batch), others(other);
  batch.setSeed(1, 77);
  batch.setChanges(1, {PlaceBody{"r0", -1, -1, 0.5}});
  batch.reset(arrays.observations);
  const std::vector<float> actions{0.5f, 0.25f, 0.25f, -0.5f};
  batch.step(actions, arrays.results());
  for (const std::size_t i : {0, 1}) other.restore(i, batch.save(i));
  for (const bool ends : {false, true}) {
    if (ends) {
      for (auto* of : {&batch, &other}) of->endEpisode(1);
    }
    batch.step(actions, arrays.results());
    other.step(actions, others.results());
    EXPECT_EQ(others.observations, arrays.observations);
    EXPECT_EQ(other.environment(1).state(), batch.environment(1).state());
  }
  EXPECT_EQ(batch.environment(1).time().step, 0u);  // the next episode, which begins with the change
  EXPECT_EQ(arrays.observations[3], -1.f);
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
