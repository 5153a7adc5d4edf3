// A stock SLAM program on a simulated and recorded run.
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/scenarios/program.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

TEST(IcpSlam, FollowsARecordedRunThroughTheMaze) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.rawlog";
  const Ended run = runProgram("run worlds/maze_20x20.xml --time 60 --record '" + rawlog.string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const std::string robot : {"Pioneer1", "Pioneer2", "Pioneer3", "Pioneer4"}) {
    const PathError error = icpSlamError(rawlog, robot, "laser", "icp-slam-exact.ini", folder / robot);
    std::printf("%s: icp-slam over %zu poses is %.3f m from the truth (RMS), %.3f m at worst\n", robot.c_str(),
                error.poses, error.rms_m, error.worst_m);
    EXPECT_GT(error.poses, 300u);
    EXPECT_LT(error.rms_m, 0.15) << robot;
  }
}

TEST(IcpSlam, CorrectsTheOdometryOfARunWithTheErrorsOfAllSensors) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.rawlog";
  const Ended run =
      runProgram("run worlds/maze_20x20.xml --noise all --seed 1 --time 60 --record '" + rawlog.string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const std::string robot : {"Pioneer1", "Pioneer4"}) {
    const PathError error = icpSlamError(rawlog, robot, "laser", "icp-slam.ini", folder / robot);
    std::printf("%s: icp-slam over %zu poses is %.3f m from the truth (RMS), the odometry %.3f m\n", robot.c_str(),
                error.poses, error.rms_m, error.odometry_rms_m);
    EXPECT_LT(error.rms_m, 0.5) << robot;
    EXPECT_LT(error.rms_m, 0.6 * error.odometry_rms_m) << robot;
  }
}

}  // namespace
}  // namespace robosim
