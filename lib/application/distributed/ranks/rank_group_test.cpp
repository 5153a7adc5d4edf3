#include "distributed/ranks/rank_group.h"

#include <cstdlib>
#include <mutex>

#include <gtest/gtest.h>

#include "distributed/ranks/launcher.h"
#include "distributed/ranks/testing/rank_group_checks.h"
#include "distributed/ranks/testing/thread_ranks.h"

namespace robosim {
namespace {

TEST(RankGroup, OfAProcessStartedAloneHasOneRankWithAllOperations) {
  EXPECT_EQ(rankGroup().size(), 1);
  EXPECT_TRUE(rankGroup().isFirst());
  EXPECT_EQ(faultOf(rankGroup()), "");
}

TEST(RankGroup, OfThreadsHasTheOperationsThatTestsNeed) {
  for (const int ranks : {1, 2, 3, 8}) {
    runThreadRanks(ranks, [](RankGroup& group) {
      if (const auto fault = faultOf(group); !fault.empty()) throw std::runtime_error(fault);
    });
  }
}

/// Sets environment variables for the duration of a test.
class LaunchedRankTest : public testing::Test {
 protected:
  static constexpr const char* kNames[] = {
      "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "PMI_RANK",    "PMI_SIZE", "PMIX_RANK",
      "SLURM_STEP_NUM_TASKS", "SLURM_NTASKS",         "SLURM_PROCID"};
  void SetUp() override { TearDown(); }
  void TearDown() override {
    for (const char* name : kNames) unsetenv(name);
  }
};

TEST_F(LaunchedRankTest, IsOfAProcessAloneWithoutALauncher) {
  EXPECT_EQ(launchedRank().size, 1);
  setenv("SLURM_NTASKS", "8", 1);  // in a batch script itself
  setenv("SLURM_PROCID", "0", 1);
  EXPECT_EQ(launchedRank().size, 1);
}

TEST_F(LaunchedRankTest, IsThatOfOpenMpiOrPmiOrSlurm) {
  setenv("PMIX_RANK", "3", 1);
  setenv("SLURM_STEP_NUM_TASKS", "4", 1);
  EXPECT_EQ(launchedRank().rank, 3);
  EXPECT_EQ(launchedRank().size, 4);
  setenv("PMI_RANK", "1", 1);
  setenv("PMI_SIZE", "5", 1);
  EXPECT_EQ(launchedRank().size, 5);
  setenv("OMPI_COMM_WORLD_RANK", "2", 1);
  setenv("OMPI_COMM_WORLD_SIZE", "6", 1);
  EXPECT_EQ(launchedRank().rank, 2);
  EXPECT_EQ(launchedRank().size, 6);
}

TEST_F(LaunchedRankTest, IgnoresNumbersThatALauncherCannotHaveSet) {
  for (const char* size : {"", "x", "-3", "2 ", "2"}) {
    setenv("OMPI_COMM_WORLD_RANK", "2", 1);
    setenv("OMPI_COMM_WORLD_SIZE", size, 1);
    EXPECT_EQ(launchedRank().size, 1) << size;
  }
}

}  // namespace
}  // namespace robosim
