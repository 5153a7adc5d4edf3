// A run whose state is restored continues bit for bit, with the same outcome, whatever happened between saving and
// restoring, and through all handles of its robots: nothing but the State remembers.
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/random.h"
#include "control/robot.h"
#include "environment/local_hardware.h"
#include "environment/state_bytes.h"
#include "environment/testing/small_world.h"
#include "maze/controllers.h"
#include "robots/robot_types.h"
#include "run/local_run.h"
#include "run/run_summary.h"

namespace robosim {
namespace {

constexpr int kRuns = 12;
constexpr std::uint32_t kSteps = 60;
constexpr const char* kScripted = "restored_run_script";

/// Commands a robot by random numbers that depend on the seed, the robot and the step only.
void commandAtRandom(Robot& robot, std::uint64_t seed, std::uint32_t index) {
  Rng rng(seed, RandomPurpose::test, index, 1, robot.stepNumber());
  if (rng.below(3) == 0) robot.drive(rng.uniform(-1, 1), rng.uniform(-2, 2));
  if (rng.below(10) == 0) robot.panLaser(rng.uniform(-1, 1));
  if (rng.below(10) == 0) robot.stopInEmergency();
  if (rng.below(10) == 0) robot.broadcast("step " + std::to_string(robot.stepNumber()));
  if (rng.below(20) == 0) robot.checkWin();
  if (rng.below(60) == 0) robot.halt();
  if (rng.below(60) == 0) robot.halt(Activity::found);
}

/// A controller without memory.
class ScriptedController : public Controller {
 public:
  explicit ScriptedController(const ControllerSetup& setup) : seed_(setup.seed), index_(setup.robot) {}
  void step(Robot& robot) override { commandAtRandom(robot, seed_, index_); }

 private:
  std::uint64_t seed_;
  std::uint32_t index_;
};

/// Four robots of two types, each with the next as its neighbour, among random walls, with gold and a radio that loses
/// messages.
LoadedWorld randomWorld(std::uint64_t seed) {
  Rng rng(seed, RandomPurpose::test, 0, 2);
  LoadedWorld made{robosim::emptyWorld(4), {}};
  made.world.communication.loss_probability = 0.1;
  for (int i = 0; i < 4; ++i) {
    addWall(made.world, rng.uniform(-3, 3), rng.uniform(-0.8, 0.8), rng.uniform(0.1, 1), 0.1);
    RobotPlacement robot;
    robot.name = "r" + std::to_string(i);
    robot.neighbour = "r" + std::to_string((i + 1) % 4);
    robot.model = i % 2 == 0 ? "pioneer3dx" : "scout";
    robot.world_from_robot = {i < 2 ? -2.5 : 2.5, i % 2 == 0 ? -2.5 : 2.5, rng.uniform(-3, 3)};
    made.world.robots.push_back(robot);
  }
  addGold(made.world, rng.uniform(-2, 0), -2.5, 0.1);
  ErrorList errors;
  made.fleet = buildFleet(made.world, "made.xml", robotTypesIn({ROBOSIM_SOURCE_DIR "/worlds/robots"}), {}, errors);
  errors.throwIfAny();
  return made;
}

std::unique_ptr<LocalRun> runOf(std::uint64_t seed, const std::string& controller) {
  return std::make_unique<LocalRun>(randomWorld(seed),
                                    RunOptions{.environment = {.seed = seed}, .controller = controller});
}

/// Takes steps in which handles other than the run's command the robots, robots are placed and removed, and the task
/// may end.
void makeDetour(Environment& environment, std::uint64_t seed) {
  Rng rng(seed, RandomPurpose::test, 0, 3);
  for (std::uint32_t step = 1 + rng.below(20); step > 0; --step) {
    for (std::uint32_t i = 0; i < environment.robotCount(); ++i) {
      LocalHardware hardware(environment, i);
      Robot robot(hardware);
      commandAtRandom(robot, seed + 1000, i);
      const PlaceBody place{robot.name(), rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)};
      if (rng.below(10) == 0) static_cast<void>(environment.apply({"test", place}));
      if (rng.below(20) == 0) environment.remove(i);
      if (rng.below(10) == 0) robot.halt(Activity::found);
    }
    environment.step();
  }
}

std::string summaryOf(const LocalRun& run) {
  auto summary = RunSummary::of(run).json();
  for (const char* of_the_clock : {"wall_s", "real_time_factor"}) summary.erase(of_the_clock);
  return summary.dump(1);
}

void expectSame(const LocalRun& run, const LocalRun& undisturbed, const std::string& which) {
  EXPECT_EQ(run.environment().state(), undisturbed.environment().state()) << which;
  EXPECT_EQ(summaryOf(run), summaryOf(undisturbed)) << which;
}

class RestoredRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    controllers().add(
        {kScripted, "Commands its robot at random.", {}, {}, [](const ControllerSetup& setup, const auto&) {
           return std::make_unique<ScriptedController>(setup);
         }});
  }
};

TEST_F(RestoredRun, ContinuesWithTheSameOutcomeWhateverHappenedMeanwhile) {
  int found = 0, won = 0, all_halted = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const auto undisturbed = runOf(seed, kScripted), run = runOf(seed, kScripted);
    const std::uint32_t saved_at = Rng(seed, RandomPurpose::test, 0, 4).below(kSteps);
    for (std::uint32_t i = 0; i < kSteps; ++i) undisturbed->step();
    for (std::uint32_t i = 0; i < saved_at; ++i) run->step();
    Environment& environment = run->environment();
    const std::string saved = toBytes(*environment.model(), environment.state());
    const std::string summary = summaryOf(*run);

    for (std::uint32_t i = 0; i < 2 * kSteps; ++i) run->step();  // through the handles of the controllers
    makeDetour(environment, seed);
    found += run->gold().found_by ? 1 : 0;
    won += run->gold().won_by ? 1 : 0;
    all_halted += run->gold().all_halted_s ? 1 : 0;

    environment.restore(stateFromBytes(*environment.model(), saved));
    EXPECT_EQ(summaryOf(*run), summary) << "seed " << seed << ", saved at step " << saved_at;
    for (std::uint32_t i = saved_at; i < kSteps; ++i) run->step();
    expectSame(*run, *undisturbed, "seed " + std::to_string(seed) + ", saved at step " + std::to_string(saved_at));
  }
  EXPECT_GT(found, 5) << "few detours find gold";
  EXPECT_GT(won, 0);
  EXPECT_GT(all_halted, 0);
}

TEST_F(RestoredRun, ContinuesWithACopyOfEveryController) {
  int tried = 0;
  for (const auto& type : controllers().types()) {
    if (type.name == kScripted || needPictures(randomWorld(1).fleet, type.name)) continue;
    ++tried;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const auto undisturbed = runOf(seed, type.name);
      for (std::uint32_t i = 0; i < kSteps / 2; ++i) undisturbed->step();
      const auto run = undisturbed->fork();
      Environment& environment = run->environment();
      const State saved = environment.state();
      makeDetour(environment, seed);
      environment.restore(saved);
      for (std::uint32_t i = 0; i < kSteps / 2; ++i) {
        run->step();
        undisturbed->step();
      }
      expectSame(*run, *undisturbed, type.name + ", seed " + std::to_string(seed));
    }
  }
  EXPECT_GT(tried, 5);
}

TEST_F(RestoredRun, ObeysARobotThatHasHaltedMeanwhile) {
  const auto run = runOf(1, "still");
  Environment& environment = run->environment();
  LocalHardware hardware(environment, 0);
  Robot robot(hardware);
  robot.drive(0.2, 0);
  const State saved = environment.state();
  robot.halt(Activity::found);
  run->step();
  EXPECT_EQ(robot.activity(), Activity::found);
  EXPECT_EQ(run->gold().found_by, "r0");
  EXPECT_EQ(run->gold().found_s, 0.1);
  environment.restore(saved);
  EXPECT_EQ(robot.command(), Command{.speed_mps = 0.2});
  EXPECT_EQ(run->gold().found_by, std::nullopt);
  robot.drive(0.1, 0);
  EXPECT_EQ(environment.state().commands[0], Command{.speed_mps = 0.1});
}

}  // namespace
}  // namespace robosim
