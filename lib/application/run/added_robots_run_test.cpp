#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "maze/controllers.h"
#include "robots/robot_types.h"
#include "run/local_run.h"
#include "world/world_file.h"

namespace robosim {
namespace {

/// A square of 10 m with a scout that does not move, and a timeline.
LoadedWorld oneScout(const std::string& timeline = "") {
  ErrorList errors;
  LoadedWorld loaded = placedWorld(
      parseWorld(
          "<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size><object><shape>"
          "<robot model='scout' name='A' x='0' y='0'><controller>still</controller></robot></shape></object>"
          "</surface>" +
              timeline + "</world>",
          "w.xml", errors),
      "w.xml", robotTypesIn(robotTypeFolders("w.xml")), checkController, 1, errors);
  errors.throwIfAny();
  return loaded;
}

AddRobot wanderer(const std::string& name, double x_m) { return {name, "scout", {x_m, 3, 0}, "wander"}; }

std::string applyTo(LocalRun& run, const Change& change) { return run.environment().apply({"test", change}); }

TEST(AddedRobotsInARun, HaveTheControllerOfTheirElementFromTheNextStep) {
  LocalRun run(oneScout(), {});
  run.step();
  ASSERT_EQ(applyTo(run, wanderer("B", -3)), "");
  for (int i = 0; i < 20; ++i) run.step();
  EXPECT_EQ(run.environment().state().driven_m[0], 0);
  EXPECT_GT(run.environment().state().driven_m[1], 0.1);
}

TEST(AddedRobotsInARun, WithoutAControllerHaveThatOfTheRun) {
  RunOptions options;
  options.controller = "wander";
  LocalRun run(oneScout(), options);
  ASSERT_EQ(applyTo(run, AddRobot{"B", "scout", {-3, 3, 0}}), "");
  ASSERT_EQ(applyTo(run, AddRobot{"C", "scout", {3, 3, 0}, "still"}), "");
  for (int i = 0; i < 20; ++i) run.step();
  EXPECT_GT(run.environment().state().driven_m[1], 0.1);
  EXPECT_EQ(run.environment().state().driven_m[2], 0);
}

TEST(AddedRobotsInARun, AreRefusedForAnImpossibleController) {
  LocalRun run(oneScout(), {});
  AddRobot added = wanderer("B", -3);
  added.controller = "wonder";
  EXPECT_NE(applyTo(run, added).find("wonder"), std::string::npos);
  added = {"B", "pioneer3dx_camera", {-3, 3, 0}, "still"};
  EXPECT_TRUE(applyTo(run, added).starts_with("no robot had a camera at the start")) << applyTo(run, added);
  RunOptions options;
  options.check_added = [](const FleetRobot& robot) { return robot.info.name + " not now"; };
  LocalRun closed(oneScout(), options);
  EXPECT_EQ(applyTo(closed, wanderer("B", -3)), "B not now");
  EXPECT_EQ(run.environment().robotCount(), 1u);
}

TEST(AddedRobotsInARun, OfAWorldFileThatTheRunDoesNotAllowAreRefusedBeforeIt) {
  const std::string adds = "<at time='5'><add><robot model='scout' name='B' x='3' y='3'/></add></at>";
  RunOptions options;
  options.check_added = [](const FleetRobot&) { return "no room in the recording"; };
  try {
    LocalRun(oneScout(adds), options);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "the world adds the robot 'B' during the run: no room in the recording");
  }
  // Whether pictures are taken does not matter.
  for (const bool takes_pictures : {false, true}) {
    options = {};
    options.takes_pictures = takes_pictures;
    const std::string camera = "<at time='5'><add><robot model='pioneer3dx_camera' name='B' x='3' y='3'/></add></at>";
    EXPECT_THROW(LocalRun(oneScout(camera), options), ConfigError);
  }
}

TEST(AddedRobotsInARun, OfAWorldFileGiveTheSameDigestForAnyNumberOfThreads) {
  const auto digest = [](int threads) {
    RunOptions options;
    options.environment.threads = threads;
    LocalRun run(oneScout("<at time='1'><add><robot model='scout' name='B' x='3' y='3'><controller>wander</controller>"
                          "</robot></add></at><at time='2'><add><robot model='pioneer3dx' name='C' x='-3' y='3'/></add>"
                          "</at>"),
                 options);
    for (int i = 0; i < 100; ++i) run.step();
    EXPECT_EQ(run.environment().robotCount(), 3u);
    return run.environment().digest();
  };
  const std::string one = digest(1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(digest(threads), one);
}

TEST(AddedRobotsInARun, ContinueInAForkAndLeaveWithARestoredState) {
  LocalRun run(oneScout(), {});
  const State start = run.environment().state();
  ASSERT_EQ(applyTo(run, wanderer("B", -3)), "");
  for (int i = 0; i < 10; ++i) run.step();
  const auto fork = run.fork();
  for (int i = 0; i < 10; ++i) {
    run.step();
    fork->step();
  }
  EXPECT_EQ(fork->environment().state(), run.environment().state());
  run.environment().restore(start);
  run.step();
  EXPECT_EQ(run.environment().robotCount(), 1u);
  ASSERT_EQ(applyTo(run, wanderer("D", 3)), "");
  for (int i = 0; i < 20; ++i) run.step();
  EXPECT_GT(run.environment().state().driven_m[1], 0.1) << "it has a controller of its own";
}

}  // namespace
}  // namespace robosim
