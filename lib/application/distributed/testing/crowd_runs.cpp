#include "distributed/testing/crowd_runs.h"

#include <algorithm>
#include <memory>
#include <sstream>

#include "base/random.h"
#include "distributed/ranks/testing/thread_ranks.h"
#include "run/registry.h"

namespace robosim {
namespace {

class Dasher : public Controller {
 public:
  explicit Dasher(const ControllerSetup& setup) : rng_(setup.seed, RandomPurpose::controller, setup.robot) {}

  void step(Robot& robot) override {
    if (robot.activity() != Activity::active) return;
    const auto step = robot.stepNumber();
    if (rng_.below(10) == 0) turn_radps_ = rng_.uniform(-2, 2);
    if (!robot.inbox().empty()) turn_radps_ = -turn_radps_;
    double nearest_m = 10;
    for (const auto& echo : robot.laser()) nearest_m = std::min<double>(nearest_m, echo.range_m);
    const bool is_omni = robot.info().type->drive.kind == DriveKind::omni;
    robot.drive(nearest_m < 0.4 ? -1 : 3, nearest_m < 0.8 ? 3 : turn_radps_, is_omni ? turn_radps_ : 0);
    const std::uint32_t chance = rng_.below(1000);
    const auto other = rng_.below(static_cast<std::uint32_t>(robot.robots().size()));
    if (chance < 5) robot.send(robot.robots()[other], "turn in step " + std::to_string(step));
    if (chance == 7) robot.broadcast("turn in step " + std::to_string(step));
    if (chance == 5) robot.checkWin();
    if (chance == 6) robot.halt();
    if (chance >= 900) robot.setLeds({chance % 2 == 0 ? 1.0f : 0.0f, 0.2f, 0.8f});
    if (robot.cameraHead() && chance >= 800) {
      robot.aimCamera((static_cast<int>(chance) - 900) / 50.0, 0.3);
      robot.zoomCamera(1 + chance % 7);
    }
  }

 private:
  Rng rng_;
  double turn_radps_ = 0;
};

}  // namespace

void addDasher() {
  static const bool is_added = [] {
    Registry registry;
    registry.controllers.add({"dasher", "Drives fast.", {}, {}, [](const ControllerSetup& setup, const auto&) {
                                return std::make_unique<Dasher>(setup);
                              }});
    addToProgram(registry);
    return true;
  }();
  static_cast<void>(is_added);
}

std::string resultOf(const LocalRun& run) {
  const State& state = run.environment().state();
  std::ostringstream text;
  text.precision(17);
  text << run.environment().digest() << ' ' << state.time.step << ' ' << state.stalls << ' ' << state.messages_delivered
       << ' ' << state.messages_dropped << ' ' << messagesSent(state) << ' ' << run.gold().won_by.value_or("-") << ' '
       << run.gold().found_by.value_or("-") << ' ' << run.gold().all_halted_s.value_or(-1);
  for (std::size_t i = 0; i < state.world_from_robot.size(); ++i) {
    const auto& pose = state.world_from_robot[i];
    text << '\n'
         << pose.x << ' ' << pose.y << ' ' << pose.phi << ' ' << state.driven_m[i] << ' '
         << static_cast<int>(state.activity[i]) << ' ' << static_cast<int>(state.stalled[i]);
  }
  return text.str();
}

std::string resultAlone(const LoadedWorld& world, int steps) {
  LocalRun run(world, {});
  for (int i = 0; i < steps && !run.isOver(); ++i) run.step();
  return resultOf(run);
}

OnRanks runOf(const LoadedWorld& world, int steps, int ranks, DistributionOptions options) {
  OnRanks out;
  RunOptions run_options;
  run_options.environment.threads = 1 + ranks % 2;
  runThreadRanks(ranks, [&](RankGroup& group) {
    DistributedRun run(group, world, run_options, options);
    for (int i = 0; i < steps && !run.run().isOver(); ++i) run.step(false, nullptr);
    run.finish(nullptr);
    auto measured = run.measured();
    if (group.isFirst()) out = {resultOf(run.run()), run.exchangeText(), std::move(measured)};
  });
  return out;
}

}  // namespace robosim
