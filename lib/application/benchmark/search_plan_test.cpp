#include "benchmark/search_plan.h"

#include <gtest/gtest.h>

#include "base/error_list.h"

namespace robosim {
namespace {

TEST(SearchPlan, NumbersItsCases) {
  SearchPlan plan;
  plan.worlds = {"a", "b", "c"};
  plan.strategies = {"x", "y"};
  plan.teams = {1, 4};
  plan.conditions = {Condition{}, Condition::parse("noise")};
  plan.runs = 5;
  ASSERT_EQ(plan.caseCount(), 24u);
  EXPECT_EQ(plan.runCount(), 120u);
  for (std::size_t i = 0; i < plan.caseCount(); ++i) EXPECT_EQ(plan.indexOf(plan.caseAt(i)), i);
  EXPECT_EQ(plan.caseAt(1), (SearchPlan::Case{0, 0, 0, 1}));  // strategies are neighbours
  EXPECT_EQ(plan.caseAt(23), (SearchPlan::Case{2, 1, 1, 1}));
  EXPECT_EQ(plan.caseName(plan.caseAt(23)), "c, 4 robots, noise, y");
}

TEST(Condition, ReadsWhatItWrites) {
  for (const std::string text :
       {"ideal", "noise", "errors", "loss=0.25", "breakdown_s=300", "noise+loss=0.5+breakdown_s=60"}) {
    EXPECT_EQ(Condition::parse(text).text(), text);
  }
  EXPECT_EQ(Condition::parse("loss=0.5+noise"), Condition::parse("noise+loss=0.5"));
}

TEST(Condition, RefusesWhatItDoesNotKnow) {
  for (const std::string text :
       {"", "nois", "noise+errors", "noise+noise", "loss", "loss=0", "loss=1.1", "loss=nan", "breakdown_s=0.5",
        "ideal+noise", "loss=0.3+loss=0.5", "breakdown_s=5+breakdown_s=9"}) {
    EXPECT_THROW(Condition::parse(text), ConfigError) << text;
  }
}

}  // namespace
}  // namespace robosim
