#include "console/rounds.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Phase = Rounds::Phase;

/// Rounds of 60 s, of a robot whose run can be replaced.
struct RoundsTest : testing::Test {
  Rounds rounds{{.length = seconds(60), .teams = {}}};
  Rounds::Inputs inputs{.may_restart = true, .is_up = true, .update = updateAt(10, 5)};
  Rounds::Time now{std::chrono::hours(1)};

  /// The robot's update at a simulation time [s], when it has driven a distance [m].
  static std::shared_ptr<const RobotUpdate> updateAt(double time_s, double driven_m) {
    auto update = std::make_shared<RobotUpdate>();
    update->readings.time = {static_cast<std::uint64_t>(time_s * 10), 0.1};
    update->state.set_driven_m(driven_m);
    return update;
  }
  Rounds::Actions after(milliseconds time) {
    now += time;
    return rounds.update(inputs, now);
  }
  /// The new run begins: the robot leaves the old one, joins the new one, which is then started, and reports from it.
  void replaceRun() {
    EXPECT_TRUE(after(milliseconds(50)).begins);
    inputs.is_up = false;
    after(milliseconds(50));
    inputs.is_up = true;
    inputs.is_run_over = inputs.has_won = false;
    EXPECT_TRUE(after(milliseconds(50)).resumes);
    inputs.update = updateAt(0.1, 0);
    after(milliseconds(50));
    ASSERT_EQ(rounds.phase(), Phase::driving);
  }
};

TEST_F(RoundsTest, AVisitorWhoFindsNoOtherBeginsAtOnceInANewRun) {
  EXPECT_TRUE(rounds.join({1, "Ada"}, now));
  EXPECT_EQ(rounds.phase(), Phase::starting);
  const auto actions = after(milliseconds(50));
  EXPECT_TRUE(actions.restarts);
  ASSERT_TRUE(actions.begins);
  EXPECT_EQ(actions.begins->page, 1u);
  inputs.update = updateAt(10.1, 5);
  EXPECT_FALSE(after(milliseconds(50)).restarts) << "once";
  EXPECT_EQ(rounds.phase(), Phase::starting) << "the robot is still in the old run";
  inputs.is_up = false;
  EXPECT_FALSE(after(milliseconds(50)).resumes) << "the robot has not joined the new run, which is paused";
  inputs.is_up = true;
  EXPECT_TRUE(after(milliseconds(50)).resumes);
  after(milliseconds(50));
  EXPECT_EQ(rounds.phase(), Phase::starting);
  inputs.update = updateAt(0.1, 0);
  after(milliseconds(50));
  EXPECT_EQ(rounds.phase(), Phase::driving);
  EXPECT_EQ(rounds.secondsLeft(now), 60);
}

TEST_F(RoundsTest, ARunThatCannotBeReplacedIsContinued) {
  inputs.may_restart = false;
  rounds.join({1, "Ada"}, now);
  const auto actions = after(milliseconds(50));
  EXPECT_FALSE(actions.restarts);
  EXPECT_TRUE(actions.begins);
  after(milliseconds(50));
  EXPECT_EQ(rounds.phase(), Phase::starting) << "not before a report";
  inputs.update = updateAt(10.1, 5);
  after(milliseconds(50));
  EXPECT_EQ(rounds.phase(), Phase::driving);
}

TEST_F(RoundsTest, ARoundWithoutANewRunIsCancelledAfter20Seconds) {
  inputs.may_restart = false;
  inputs.is_run_over = true;
  rounds.join({1, "Ada"}, now);
  after(milliseconds(50));
  EXPECT_FALSE(after(seconds(19)).failed);
  const auto actions = after(seconds(1));
  ASSERT_TRUE(actions.failed);
  EXPECT_EQ(actions.failed->name, "Ada");
  EXPECT_EQ(rounds.phase(), Phase::idle);
}

TEST_F(RoundsTest, ARunThatTheRobotDoesNotJoinIsStartedAfter5Seconds) {
  rounds.join({1, "Ada"}, now);
  after(milliseconds(50));
  inputs.is_up = false;
  EXPECT_FALSE(after(milliseconds(4949)).resumes);
  EXPECT_TRUE(after(milliseconds(1)).resumes);
  EXPECT_FALSE(after(seconds(1)).resumes);
}

TEST_F(RoundsTest, ARunThatIsPausedIsStartedWhenTheVisitorLeaves) {
  rounds.join({1, "Ada"}, now);
  after(milliseconds(50));
  rounds.leave(1, now);
  inputs.is_restarting = true;
  EXPECT_FALSE(after(milliseconds(50)).resumes) << "not before it is loaded";
  inputs.is_restarting = false;
  EXPECT_TRUE(after(milliseconds(50)).resumes);
  EXPECT_FALSE(after(milliseconds(50)).resumes);
}

TEST_F(RoundsTest, AWinEndsTheRoundWithItsTimeAndDistance) {
  rounds.join({1, "Ada", "Red"}, now);
  replaceRun();  // at 0.1 s and 0 m
  inputs.update = updateAt(30.1, 12.5);
  inputs.has_won = inputs.is_run_over = true;
  const auto actions = after(seconds(30));
  ASSERT_TRUE(actions.ends);
  EXPECT_TRUE(actions.ends->has_won);
  EXPECT_EQ(actions.ends->visitor.team, "Red");
  EXPECT_DOUBLE_EQ(actions.ends->time_s, 30);
  EXPECT_DOUBLE_EQ(*actions.ends->distance_m, 12.5);
  EXPECT_EQ(rounds.phase(), Phase::result);
  EXPECT_EQ(rounds.secondsLeft(now), 12);
}

TEST_F(RoundsTest, ARoundEndsAfterItsLengthWithoutAWin) {
  rounds.join({1, "Ada"}, now);
  replaceRun();
  EXPECT_FALSE(after(milliseconds(59'999)).ends);
  EXPECT_EQ(rounds.secondsLeft(now), 1);
  const auto actions = after(milliseconds(1));
  ASSERT_TRUE(actions.ends);
  EXPECT_FALSE(actions.ends->has_won);
  after(seconds(12));
  EXPECT_EQ(rounds.phase(), Phase::idle);
}

TEST_F(RoundsTest, AnotherRobotsWinEndsTheRoundWithoutAWin) {
  rounds.join({1, "Ada"}, now);
  replaceRun();
  inputs.is_run_over = true;
  EXPECT_FALSE(after(seconds(1)).ends->has_won);
}

TEST_F(RoundsTest, VisitorsAreCalledInTurnAndMustConfirmWithin20Seconds) {
  rounds.join({1, "Ada"}, now);
  rounds.join({2, "Bea"}, now);
  rounds.join({3, "Cem"}, now);
  replaceRun();
  rounds.start(2, now);
  EXPECT_EQ(rounds.visitor()->page, 1u) << "not before Bea was called";
  after(seconds(60));
  after(seconds(12));
  ASSERT_EQ(rounds.phase(), Phase::called);
  EXPECT_EQ(rounds.visitor()->page, 2u);
  EXPECT_EQ(rounds.secondsLeft(now), 20);
  rounds.start(3, now);
  EXPECT_EQ(rounds.phase(), Phase::called) << "Cem was not called";
  after(seconds(20));
  EXPECT_EQ(rounds.visitor()->page, 3u) << "Bea has not confirmed";
  rounds.start(3, now);
  EXPECT_EQ(rounds.phase(), Phase::starting);
}

TEST_F(RoundsTest, AVisitorWhoLeavesEndsTheRoundOrLosesThePlace) {
  rounds.join({1, "Ada"}, now);
  rounds.join({2, "Bea"}, now);
  rounds.join({3, "Cem"}, now);
  replaceRun();
  rounds.leave(2, now);
  ASSERT_EQ(rounds.queue().size(), 1u);
  rounds.leave(1, now);
  EXPECT_EQ(rounds.phase(), Phase::called);
  EXPECT_EQ(rounds.visitor()->page, 3u);
  rounds.leave(3, now);
  EXPECT_EQ(rounds.phase(), Phase::idle);
}

TEST_F(RoundsTest, JoiningAgainChangesTheNameAndKeepsThePlace) {
  rounds.join({1, "Ada"}, now);
  rounds.join({2, "Bea"}, now);
  rounds.join({3, "Cem"}, now);
  rounds.join({2, "Beatrice", "Red"}, now);
  ASSERT_EQ(rounds.queue().size(), 2u);
  EXPECT_EQ(rounds.queue().front().name, "Beatrice");
  rounds.join({1, "Ada"}, now);
  EXPECT_EQ(rounds.queue().size(), 2u) << "Ada's round is about to begin";
}

TEST_F(RoundsTest, TheQueueIsBounded) {
  for (PageId page = 1; page <= 1 + Rounds::kMaxWaiting; ++page) EXPECT_TRUE(rounds.join({page, "Ada"}, now));
  EXPECT_FALSE(rounds.join({1000, "Ada"}, now));
  EXPECT_EQ(rounds.queue().size(), Rounds::kMaxWaiting);
}

TEST_F(RoundsTest, TheRobotExploresOnlyWhileNoVisitorDrives) {
  after(milliseconds(50));
  EXPECT_TRUE(after(seconds(5)).explores);
  rounds.join({1, "Ada"}, now);
  replaceRun();
  EXPECT_FALSE(after(seconds(30)).explores);
  rounds.leave(1, now);
  EXPECT_FALSE(after(milliseconds(4999)).explores);
  EXPECT_TRUE(after(milliseconds(1)).explores);
}

TEST_F(RoundsTest, SkippingEndsTheRoundWithItsResultAndThenTheDisplayOfIt) {
  rounds.join({1, "Ada"}, now);
  rounds.join({2, "Bea"}, now);
  replaceRun();
  rounds.skip(now);
  ASSERT_TRUE(after(milliseconds(50)).ends);
  rounds.skip(now);
  EXPECT_EQ(rounds.visitor()->page, 2u);
}

}  // namespace
}  // namespace robosim
