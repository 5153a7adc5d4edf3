#include "run/local_run.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "maze/controllers.h"

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

TEST(LocalRun, HaltsRobotsThatBreakDown) {
  RunOptions options;
  options.controller = "wander";
  options.breakdown_mean_s = 5;
  const auto world = [] { return loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/opho2_1.xml", ""); };
  LocalRun run(world(), options);
  EXPECT_TRUE(run.dependsOnSeed());
  std::size_t halted = 0;
  std::unique_ptr<LocalRun> fork;
  for (int i = 0; i < 2000 && !run.isOver(); ++i) {
    run.step();
    const auto& activity = run.environment().state().activity;
    const auto now = static_cast<std::size_t>(std::count(activity.begin(), activity.end(), Activity::halted));
    EXPECT_GE(now, halted) << "none is repaired";
    halted = now;
    if (!fork && halted > 0) fork = run.fork();
  }
  EXPECT_TRUE(run.gold().all_halted_s) << "four robots with a mean of 5 s, after 200 s";
  ASSERT_TRUE(fork);
  while (fork->environment().time().step < run.environment().time().step) fork->step();
  EXPECT_EQ(fork->environment().state(), run.environment().state());
}

TEST(LocalRun, LetsRobotsBreakDownAfterExponentiallyDistributedTimes) {
  // Of 200 robots with a mean of 10 s, exp(-1) are working after 10 s: 74 ± 4 · 6.8.
  std::string text = "<world><surface><size><xmin>-1</xmin><xmax>201</xmax><ymin>-1</ymin><ymax>1</ymax></size>";
  for (int i = 0; i < 200; ++i) {
    text += "<object><shape><robot><cylinder><name>R" + std::to_string(i) + "</name><x>" + std::to_string(i) +
            "</x><y>0</y><z>0.1</z><radius>0.2</radius><height>0.2</height></cylinder></robot></shape></object>";
  }
  WorldSource source;
  source.file = "row.xml";
  source.text = text + "</surface></world>";
  RunOptions options;
  options.controller = "still";
  options.breakdown_mean_s = 10;
  LocalRun run(loadWorldToRun(source, "still"), options);
  for (int i = 0; i < 100; ++i) run.step();
  const auto& activity = run.environment().state().activity;
  EXPECT_NEAR(static_cast<double>(std::count(activity.begin(), activity.end(), Activity::active)), 200 * std::exp(-1),
              27);
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

WorldSource worldWithCamera() {
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
  return source;
}

TEST(LocalRun, RefusesCamerasWithoutAnImageSourceMaker) {
  try {
    LocalRun(loadWorldToRun(worldWithCamera(), "still"), {});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "robots have cameras, but this program cannot render pictures; it must call "
                 "setImageSourceMaker(makeOffscreenRenderer), of the library robosim::rendering");
  }
}

TEST(LocalRun, NeedsNoImageSourceMakerWithoutPictures) {
  RunOptions options;
  options.controller = "still";
  options.takes_pictures = false;
  LocalRun run(loadWorldToRun(worldWithCamera(), "still"), options);
  run.step();
  EXPECT_EQ(run.environment().time().step, 1u);
}

TEST(LocalRun, NeedsPicturesForControllersThatRequireACamera) {
  const Fleet fleet = loadWorldToRun(worldWithCamera(), "still").fleet;
  EXPECT_FALSE(needPictures(fleet, "still"));
  const auto make = [](const ControllerSetup&, const ParameterValues&) { return std::unique_ptr<Controller>(); };
  controllers().add(
      {.name = "watcher", .help = "Watches.", .needs = {SensorKind::camera}, .parameters = {}, .make = make});
  EXPECT_TRUE(needPictures(fleet, "watcher"));
}

}  // namespace
}  // namespace robosim
