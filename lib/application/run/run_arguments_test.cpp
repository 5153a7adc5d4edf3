#include "run/run_arguments.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(RunArguments, EndARunAtItsTimeLimit) {
  RunArguments arguments;
  arguments.time_s = 0.3;  // 3 · 0.1 is slightly more
  EXPECT_FALSE(arguments.timeIsUp({2, 0.1}));
  EXPECT_TRUE(arguments.timeIsUp({3, 0.1}));
  arguments.time_s = 0.7;  // 7 · 0.1 is slightly more
  EXPECT_FALSE(arguments.timeIsUp({6, 0.1}));
  EXPECT_TRUE(arguments.timeIsUp({7, 0.1}));
}

}  // namespace
}  // namespace robosim
