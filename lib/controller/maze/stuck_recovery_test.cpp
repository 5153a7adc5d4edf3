#include "maze/stuck_recovery.h"

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"
#include "maze/wall_follower.h"
#include "maze/wander.h"

namespace robosim {
namespace {

/// Steps of 0.1 s until the robot is farther than `distance_m` from its start; `most` if that does not happen.
template <typename Step>
int stepsToLeave(FakeMaze& maze, double distance_m, int most, const Step& step) {
  Robot robot(maze.hardware);
  for (int i = 0; i < most; ++i) {
    step(robot);
    maze.hardware.advance();
    if (std::hypot(maze.pose().x, maze.pose().y) > distance_m) return i;
  }
  return most;
}

TEST(StuckRecovery, DoesNotTakeOverARobotThatMoves) {
  FakeHardware hardware;
  Robot robot(hardware);
  StuckRecovery recovery({.seed = 1});
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(recovery.takesOver(robot)) << i;
    robot.drive(0.1, 0);  // it drives 1.5 radii of 0.25 m in 3.75 s
    hardware.advance();
  }
}

TEST(StuckRecovery, TakesOverAfter15SecondsWithoutProgress) {
  FakeHardware hardware;
  Robot robot(hardware);
  StuckRecovery recovery({.seed = 1});
  for (int i = 0; i < 150; ++i) {
    ASSERT_FALSE(recovery.takesOver(robot)) << i;
    hardware.advance();
  }
  EXPECT_TRUE(recovery.takesOver(robot));
}

TEST(StuckRecovery, RecognisesProgressWithoutOdometryByTheStalls) {
  for (const bool is_blocked : {false, true}) {
    FakeHardware hardware;
    auto sensors = std::make_shared<std::vector<SensorInfo>>(*hardware.info().sensors);
    (*sensors)[0].kind = SensorKind::values;  // in place of odometry
    hardware.mutableInfo().sensors = sensors;
    hardware.blocked = is_blocked;
    Robot robot(hardware);
    StuckRecovery recovery({.seed = 1});
    for (int i = 0; i < 150; ++i) {
      ASSERT_FALSE(recovery.takesOver(robot)) << i;
      robot.drive(0.1, 0);
      hardware.advance();
    }
    EXPECT_EQ(recovery.takesOver(robot), is_blocked);
  }
}

TEST(StuckRecovery, DrivesOutOfADeadEnd) {
  // A dead end 0.6 m wide around a robot of 0.5 m, open behind the robot.
  FakeMaze maze({FakeMaze::box(0.45, 0, 0.2, 0.8), FakeMaze::box(-1, 0.4, 3, 0.2), FakeMaze::box(-1, -0.4, 3, 0.2)},
                {99, 99}, 0);
  StuckRecovery recovery({.seed = 1});
  const int steps = stepsToLeave(maze, 0.4, 6000, [&](Robot& robot) {
    if (!recovery.takesOver(robot)) robot.stop();
  });
  EXPECT_LT(steps, 6000);
}

TEST(StuckRecovery, FreesWanderFromAPocketWithANarrowExitWithinFiveMinutes) {
  // 1.2 m × 1.2 m inside, with an exit of 0.6 m for a robot of 0.5 m, which moves farther than the disc of 1.5 radii.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    FakeMaze maze({FakeMaze::box(0, 0.65, 1.4, 0.1), FakeMaze::box(0, -0.65, 1.4, 0.1),
                   FakeMaze::box(-0.65, 0, 0.1, 1.2), FakeMaze::box(0.65, 0.3, 0.1, 0.6)},
                  {99, 99}, 0);
    Wander wander({.seed = seed});
    EXPECT_LT(stepsToLeave(maze, 1.2, 3000, [&](Robot& robot) { wander.step(robot); }), 3000) << seed;
  }
}

TEST(StuckRecovery, RestartsItsTimeoutAfterAnotherControllerHasDriven) {
  FakeHardware hardware;
  Robot robot(hardware);
  StuckRecovery recovery({.seed = 1});
  EXPECT_FALSE(recovery.takesOver(robot));
  for (int i = 0; i < 200; ++i) hardware.advance();
  EXPECT_FALSE(recovery.takesOver(robot));
}

TEST(StuckRecovery, FreesWanderFromAPassageNarrowerThanItsClearance) {
  // Walls 0.1 m from both sides of the robot: nearer than its clearance.
  FakeMaze maze({FakeMaze::box(0, 0.4, 4, 0.1), FakeMaze::box(0, -0.4, 4, 0.1)}, {99, 99}, 0);
  Wander wander({.seed = 1});
  EXPECT_LT(stepsToLeave(maze, 1, 6000, [&](Robot& robot) { wander.step(robot); }), 6000);
}

TEST(StuckRecovery, FreesAWallFollowerFromAPassageNarrowerThanItsDistance) {
  FakeMaze maze({FakeMaze::box(0, 0.4, 4, 0.1), FakeMaze::box(0, -0.4, 4, 0.1), FakeMaze::box(0.6, 0, 0.1, 1)},
                {99, 99}, 0);
  WallFollower follower;
  EXPECT_LT(stepsToLeave(maze, 1, 6000, [&](Robot& robot) { follower.step(robot); }), 6000);
}

}  // namespace
}  // namespace robosim
