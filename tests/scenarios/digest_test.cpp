// The same world, seed and controllers give the same run, bit for bit.
#include <gtest/gtest.h>

#include "run/local_run.h"

namespace robosim {
namespace {

std::unique_ptr<LocalRun> start(const std::string& world, std::uint64_t seed, int threads) {
  RunOptions options;
  options.environment = {.seed = seed, .period_s = 0.1, .threads = threads};
  return std::make_unique<LocalRun>(loadWorld(ROBOSIM_SOURCE_DIR "/worlds/" + world, checkController), options);
}

std::string digestAfter(int steps, const std::string& world, std::uint64_t seed, int threads) {
  const auto run = start(world, seed, threads);
  for (int i = 0; i < steps; ++i) run->step();
  return run->environment().digest();
}

TEST(Digest, IsIdenticalFor1And2And4ThreadsAndForRepeatedRuns) {
  for (const char* world : {"open_100.xml", "maze_20x20.xml", "opho2_1.xml"}) {
    const std::string one = digestAfter(300, world, 5, 1);
    EXPECT_EQ(digestAfter(300, world, 5, 1), one) << world;
    EXPECT_EQ(digestAfter(300, world, 5, 2), one) << world;
    EXPECT_EQ(digestAfter(300, world, 5, 4), one) << world;
  }
}

TEST(Digest, DiffersForAnotherSeedAndForAnotherStep) {
  const std::string one = digestAfter(100, "open_100.xml", 1, 1);
  EXPECT_NE(digestAfter(100, "open_100.xml", 2, 1), one);
  EXPECT_NE(digestAfter(101, "open_100.xml", 1, 1), one);
}

TEST(Digest, IsIndependentOfOtherWorldsInTheProcess) {
  const std::string maze_alone = digestAfter(200, "maze_20x20.xml", 1, 1);
  const std::string open_alone = digestAfter(200, "open_100.xml", 2, 1);
  const auto maze = start("maze_20x20.xml", 1, 1);
  const auto open = start("open_100.xml", 2, 2);
  for (int i = 0; i < 200; ++i) {
    maze->step();
    open->step();
  }
  EXPECT_EQ(maze->environment().digest(), maze_alone);
  EXPECT_EQ(open->environment().digest(), open_alone);
}

}  // namespace
}  // namespace robosim
