// A fork of a run continues as its original does, including its controllers, and independently of it.
#include <gtest/gtest.h>

#include "run/local_run.h"

namespace robosim {
namespace {

struct ForkCase {
  const char* world;
  const char* controller;
  int steps;
};

class Fork : public testing::TestWithParam<ForkCase> {};

TEST_P(Fork, ContinuesBitForBit) {
  const auto& [world, controller, steps] = GetParam();
  const std::string file = std::string(ROBOSIM_SOURCE_DIR "/worlds/") + world;
  LocalRun original(loadWorld(file, checkController), {.environment = {.seed = 3}, .controller = controller});
  constexpr int kForks = 4;
  std::vector<std::unique_ptr<LocalRun>> forks;
  for (int i = 0; i < steps; ++i) {
    if (i % (steps / kForks) == steps / kForks / 2) forks.push_back(original.fork());
    original.step();
  }
  ASSERT_EQ(forks.size(), kForks);
  for (const auto& fork : forks) {
    while (fork->environment().time().step < static_cast<std::uint64_t>(steps)) fork->step();
    EXPECT_EQ(fork->environment().state(), original.environment().state());
    EXPECT_EQ(fork->environment().digest(), original.environment().digest());
    EXPECT_EQ(fork->gold().found_by, original.gold().found_by);
    EXPECT_EQ(fork->gold().all_halted_s, original.gold().all_halted_s);
    EXPECT_EQ(fork->dependsOnSeed(), original.dependsOnSeed());
  }
}

INSTANTIATE_TEST_SUITE_P(Controllers, Fork,
                         testing::Values(ForkCase{"opho2_1.xml", "gold_finder", 1500},
                                         ForkCase{"maze_20x20.xml", "wander", 200},
                                         ForkCase{"small_maze.xml", "wall_follower", 800},
                                         ForkCase{"small_maze.xml", "still", 8}),
                         [](const auto& test) { return test.param.controller; });

TEST(ForkedRun, IsImpossibleWhileAnotherProcessDrivesARobot) {
  const LocalRun run(loadWorld(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", checkController), {}, {1, 0});
  try {
    run.fork();
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "robot 'Pioneer1': another process drives it, so that its run cannot be forked; let this process run "
                 "its controller");
  }
}

}  // namespace
}  // namespace robosim
