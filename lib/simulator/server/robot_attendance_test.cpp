#include "server/robot_attendance.h"

#include <gtest/gtest.h>

#include "robots/world_source.h"

namespace robosim {
namespace {

/// The small maze, whose robots are Pioneer1 (0) and Scout1 (1), both networked.
class RobotAttendanceTest : public testing::Test {
 protected:
  RobotAttendanceTest() : environment_(loaded_.world, loaded_.fleet, {}), run_info_(environment_, source_, 1, {1, 1}) {
    attendance_.reset(run_info_);
  }
  void joinBoth() {
    attendance_.join(0, false, 0, true);
    attendance_.join(1, false, 0, true);
  }

  using Names = std::vector<std::string>;
  const std::vector<Activity> both_active_{Activity::active, Activity::active};
  const std::vector<Activity> pioneer_halted_{Activity::halted, Activity::active};
  const WorldSource source_ = readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml");
  const LoadedWorld loaded_ = loadWorld(source_, {});
  Environment environment_;
  RunInfo run_info_;
  RobotAttendance attendance_;
};

TEST_F(RobotAttendanceTest, NamesRobotsThatHaveNotJoinedAsAbsentButNotAsLost) {
  attendance_.join(1, false, 0, true);
  EXPECT_EQ(attendance_.neverJoined(), Names{"Pioneer1"});
  EXPECT_EQ(attendance_.absent(), Names{"Pioneer1"});
  EXPECT_TRUE(attendance_.lost(both_active_).empty());
  EXPECT_TRUE(attendance_.losses(both_active_).empty());
}

TEST_F(RobotAttendanceTest, CountsTheStepsThatALostRobotMisses) {
  joinBoth();
  attendance_.countStep(both_active_);
  attendance_.leave(0, true);
  attendance_.countStep(both_active_);
  attendance_.countStep(both_active_);
  EXPECT_EQ(attendance_.lost(both_active_), std::vector<std::size_t>{0});
  EXPECT_EQ(attendance_.losses(both_active_), (std::vector<LostRobot>{{"Pioneer1", 1, 2, true}}));
  attendance_.join(0, false, 0, true);
  attendance_.countStep(both_active_);
  EXPECT_EQ(attendance_.losses(both_active_), (std::vector<LostRobot>{{"Pioneer1", 1, 2, false}}));
}

TEST_F(RobotAttendanceTest, CountsRestartsOfTheControllerOfAnActiveRobot) {
  const auto rejoin = [&](bool continues, std::uint64_t step, bool is_active) {
    attendance_.leave(0, is_active);
    attendance_.join(0, continues, step, is_active);
    RunReport report;
    report.lost_robots = attendance_.losses(both_active_);
    return report.restartedRobots();
  };
  joinBoth();
  EXPECT_EQ(rejoin(false, 0, true), Names{}) << "no step was taken";
  EXPECT_EQ(rejoin(true, 5, true), Names{}) << "the same process connects again";
  EXPECT_EQ(rejoin(false, 5, false), Names{}) << "the robot had halted";
  EXPECT_EQ(rejoin(false, 5, true), Names{"Pioneer1"});
}

TEST_F(RobotAttendanceTest, DoesNotCountAHaltedRobotAsLost) {
  joinBoth();
  attendance_.leave(0, false);
  attendance_.countStep(pioneer_halted_);
  EXPECT_TRUE(attendance_.lost(pioneer_halted_).empty());
  EXPECT_TRUE(attendance_.losses(pioneer_halted_).empty());
  EXPECT_EQ(attendance_.absent(), Names{"Pioneer1"});
}

TEST(RunReport, HasAllRobotsUnlessStepsOrMessagesAreMissing) {
  RunReport report;
  EXPECT_TRUE(report.hasAllRobots());
  report.lost_robots = {{"Ann", 1, 0, false}};
  EXPECT_TRUE(report.hasAllRobots()) << "the run waited until she was back";
  report.lost_robots = {{"Ann", 1, 3, false}};
  EXPECT_FALSE(report.hasAllRobots()) << "three steps were taken without her";
  report.lost_robots = {{"Ann", 1, 0, true}};
  EXPECT_FALSE(report.hasAllRobots());
  report = {};
  report.messages_lost = 1;
  EXPECT_FALSE(report.hasAllRobots());
}

}  // namespace
}  // namespace robosim
