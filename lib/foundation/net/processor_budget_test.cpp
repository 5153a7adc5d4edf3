#include "net/processor_budget.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using namespace std::chrono_literals;

TEST(ProcessorBudget, LetsABurstPassAndThenItsShare) {
  ProcessorBudget budget(0.2, 50ms);
  const ProcessorBudget::Clock::time_point now{1h};
  EXPECT_EQ(budget.wait(now), 0ms);
  budget.spend(49ms, now);
  EXPECT_EQ(budget.wait(now), 0ms);
  budget.spend(3ms, now);
  EXPECT_EQ(budget.wait(now), 20ms) << "2 ms too much and 2 ms more take 4 ms / 0.2";
  EXPECT_EQ(budget.wait(now + 20ms), 0ms);
  budget.spend(2ms, now + 20ms);
  EXPECT_EQ(budget.wait(now + 20ms), 10ms);
}

TEST(ProcessorBudget, IsFullAfterARest) {
  ProcessorBudget budget(0.2, 50ms);
  const ProcessorBudget::Clock::time_point now{1h};
  budget.spend(60ms, now);
  budget.spend(49ms, now + 1h);
  EXPECT_EQ(budget.wait(now + 1h), 0ms);
  budget.spend(1ms, now + 1h);
  EXPECT_EQ(budget.wait(now + 1h), 10ms);
}

}  // namespace
}  // namespace robosim
