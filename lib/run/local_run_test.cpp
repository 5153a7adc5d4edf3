#include "run/local_run.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

/// Two robots of 2005 without a sensor.
LoadedWorld twoRobots(const std::string& communication) {
  std::string text = "<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size>";
  for (const char* x : {"-1", "1"}) {
    text += "<object><shape><robot><cylinder><name>R" + std::string(x) + "</name><x>" + x +
            "</x><y>0</y><z>0.1</z><radius>0.2</radius><height>0.2</height></cylinder></robot></shape></object>";
  }
  WorldSource source;
  source.file = "w.xml";
  source.text = text + "</surface>" + communication + "</world>";
  return loadWorldToRun(source, "still");
}

TEST(LocalRun, DependsOnTheSeedIfMessagesMayBeLost) {
  RunOptions options;
  options.controller = "still";
  EXPECT_FALSE(LocalRun(twoRobots(""), options).dependsOnSeed());
  EXPECT_FALSE(LocalRun(twoRobots("<communication range='3'/>"), options).dependsOnSeed());
  EXPECT_TRUE(LocalRun(twoRobots("<communication loss='0.1'/>"), options).dependsOnSeed());
  EXPECT_TRUE(LocalRun(twoRobots("<communication burst_gap_s='10'/>"), options).dependsOnSeed());
  EXPECT_FALSE(LocalRun(twoRobots("<communication delay_s='1' rate_hz='2'/>"), options).dependsOnSeed());
}

TEST(LocalRun, KeepsWhenTheGoldWasFoundAlsoInAFork) {
  LocalRun run(loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", ""), {});
  for (int i = 0; i < 6000 && !run.gold().found_s; ++i) run.step();
  ASSERT_TRUE(run.gold().found_s);
  const GoldOutcome first = run.gold();
  EXPECT_EQ(first.found_s, run.environment().state().time.seconds());
  const auto fork = run.fork();
  for (LocalRun* one : {&run, fork.get()}) {
    for (int i = 0; i < 5; ++i) one->step();
    EXPECT_EQ(one->gold().found_s, first.found_s);
    EXPECT_EQ(one->gold().found_by, first.found_by);
  }
}

TEST(LocalRun, ForksRobotsThatAreDrivenElsewhereOnRequestOnly) {
  RunOptions options;
  options.controller = "still";
  LocalRun run(twoRobots(""), options, {1, 0});
  run.environment().setCommand(0, {.speed_mps = 0.1});
  run.step();
  EXPECT_THROW(run.fork(), ConfigError);
  const auto fork = run.fork(LocalRun::Elsewhere::keep);
  for (LocalRun* one : {&run, fork.get()}) {
    for (int i = 0; i < 5; ++i) one->step();
  }
  EXPECT_GT(run.environment().state().world_from_robot[0].x, -1);
  EXPECT_EQ(fork->environment().state(), run.environment().state());
}

TEST(LocalRun, RefusesCamerasWithoutAnImageSourceMaker) {
  WorldSource source;
  source.file = "w.xml";
  source.text =
      "<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size><object><shape><robot>"
      "<model>eye</model><name>R</name><x>0</x><y>0</y><direction>0</direction></robot></shape></object></surface></"
      "world>";
  source.robot_types["eye"] = {
      "eye.xml",
      "<robot name='eye' help='Sees.'><body radius_m='0.2' height_m='0.3'/><limits speed_max_mps='1' accel_mps2='1' "
      "decel_mps2='1' turn_max_degps='9' turn_accel_degps2='9'/><sensors><camera/></sensors></robot>"};
  try {
    LocalRun(loadWorldToRun(source, "still"), {});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "robots have cameras, but this program cannot render pictures; it must call "
                 "setImageSourceMaker(makeOffscreenRenderer), of the library robosim::rendering");
  }
}

}  // namespace
}  // namespace robosim
