// A run is its Model and its State: a copy of the state saves it, and any environment of the model continues it.
#include "environment/state.h"

#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "environment/state_bytes.h"
#include "environment/testing/probe_run.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

constexpr int kRuns = 30;
constexpr std::uint32_t kSteps = 100;

TEST(State, ContinuesBitForBitFromARandomStepOfARandomRun) {
  std::uint64_t stalls = 0, messages = 0;
  int wins = 0, steps_after_a_win = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    ProbeRun run(seed);
    Environment& environment = run.environment();
    const std::uint32_t saved_at = run.random(kSteps);
    for (std::uint32_t i = 0; i < saved_at; ++i) run.step();
    // Requests between two steps, which belong to the state.
    environment.send(0, "r1", "pending");
    environment.checkWin(2);
    environment.setCommand(3, {.speed_mps = 0.3});
    const State saved = environment.state();
    const std::string bytes = toBytes(*environment.model(), saved);
    steps_after_a_win += saved.won ? 1 : 0;

    for (std::uint32_t i = saved_at; i < kSteps; ++i) run.step();
    const State end = environment.state();
    stalls += end.stalls;
    messages += end.messages_delivered;
    wins += end.won ? 1 : 0;

    const auto expect_same_end = [&](Environment& other, const char* how) {
      for (std::uint32_t i = saved_at; i < kSteps; ++i) run.step(other);
      EXPECT_EQ(other.digest(), end.digest->text()) << how << ", seed " << seed << ", saved at step " << saved_at;
      EXPECT_EQ(other.state(), end) << how << ", seed " << seed << ", saved at step " << saved_at;
    };
    environment.restore(saved);
    EXPECT_EQ(environment.state(), saved);
    expect_same_end(environment, "restored");
    const auto other = run.another();
    other->restore(stateFromBytes(*other->model(), bytes));
    expect_same_end(*other, "restored from bytes in another environment");
  }
  EXPECT_GT(stalls, 100u);
  EXPECT_GT(messages, 1000u);
  EXPECT_GT(wins, 0);
  EXPECT_GT(steps_after_a_win, 0);
}

/// Three robots among two walls.
std::unique_ptr<Environment> smallRun() {
  World world = emptyWorld(3);
  addWall(world, 1, 0, 0.1, 2);
  addWall(world, -1, 0, 0.1, 2);
  Fleet fleet;
  for (int i = 0; i < 3; ++i) addDisc(world, fleet, "r" + std::to_string(i), {1.7 * (i - 1), 0.2 * i, 0.5 * i});
  return std::make_unique<Environment>(std::move(world), std::move(fleet), EnvironmentOptions{});
}

TEST(State, HasTheSeedOfARestartSoThatAnyEnvironmentContinuesIt) {
  ProbeRun run(1);
  Environment& environment = run.environment();
  const std::string first = environment.digest();
  State start = initialState(*environment.model());
  environment.restart(start);
  EXPECT_EQ(environment.digest(), first);

  start.seed = 99;
  environment.restart(start);
  for (int i = 0; i < 10; ++i) run.step();
  const std::string bytes = toBytes(*environment.model(), environment.state());
  for (int i = 0; i < 10; ++i) run.step();
  const auto other = run.another();
  other->restore(stateFromBytes(*other->model(), bytes));
  for (int i = 0; i < 10; ++i) run.step(*other);
  EXPECT_EQ(other->digest(), environment.digest());

  start.seed = 1;
  environment.restart(start);
  for (int i = 0; i < 20; ++i) run.step();
  EXPECT_NE(environment.digest(), other->digest()) << "noise does not depend on the seed";
}

TEST(State, WithoutADigestContinuesTheSameRunAndComputesNone) {
  ProbeRun run(1);
  for (int i = 0; i < 10; ++i) run.step();
  State start = run.environment().state();
  start.digest.reset();
  const auto other = run.another();
  other->restore(start);
  for (int i = 0; i < 10; ++i) {
    run.step();
    run.step(*other);
  }
  State end = run.environment().state();
  end.digest.reset();
  EXPECT_EQ(other->state(), end);
  try {
    other->digest();
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "this run computes no digest; start it from a state with a digest, as initialState() has");
  }
}

TEST(State, RefusesADigestOfAnotherNumberOfRobots) {
  const auto run = smallRun();
  State state = run->state();
  state.digest = RunDigest(1000);
  EXPECT_THROW(run->restore(state), std::invalid_argument);
}

TEST(State, TenThousandForksOfARunDependOnlyOnTheirCommands) {
  constexpr int kForks = 10'000, kVariants = 10, kForkSteps = 3;
  const auto run = smallRun();
  const auto advance = [](Environment& environment, int variant) {
    for (int i = 0; i < kForkSteps; ++i) {
      for (std::size_t robot = 0; robot < 3; ++robot) {
        environment.setCommand(robot, {.speed_mps = 0.1 * variant, .turn_radps = 0.2 * static_cast<double>(robot)});
      }
      environment.step();
    }
    return environment.digest();
  };
  for (int i = 0; i < 20; ++i) run->step();
  const State saved = run->state();
  std::vector<std::string> digests;
  for (int variant = 0; variant < kVariants; ++variant) {
    run->restore(saved);
    digests.push_back(advance(*run, variant));
  }
  EXPECT_EQ(std::set<std::string>(digests.begin(), digests.end()).size(), digests.size());
  run->restore(saved);
  for (int i = 0; i < kForks; ++i) {
    Environment fork(run->model(), run->state());
    ASSERT_EQ(advance(fork, i % kVariants), digests[static_cast<std::size_t>(i % kVariants)]) << "fork " << i;
  }
  EXPECT_EQ(run->state(), saved) << "a fork has changed its original";
}

TEST(State, DiffersInEachOfItsParts) {
  ProbeRun run(1);
  run.step();
  const State state = run.environment().state();
  const std::function<void(State&)> changes[] = {
      [](State& s) { ++s.time.step; },
      [](State& s) { ++s.seed; },
      [](State& s) { s.world_from_robot[1].x += 1; },
      [](State& s) { s.speed_mps[1] += 1; },
      [](State& s) { s.turn_radps[1] += 1; },
      [](State& s) { s.last_motion[1].turn_rad += 1; },
      [](State& s) { s.driven_m[1] += 1; },
      [](State& s) { s.stalled[1] ^= 1; },
      [](State& s) { s.activity[1] = Activity::found; },
      [](State& s) { s.laser_pan_rad[1] += 1; },
      [](State& s) { s.commands[1].by_driver = !s.commands[1].by_driver; },
      [](State& s) { s.commands[1].emergency_stop = !s.commands[1].emergency_stop; },
      [](State& s) { s.commands[1].grip = !s.commands[1].grip; },
      [](State& s) { s.commands[1].led_color ^= 0xff0000; },
      [](State& s) { s.commands[1].camera_head.edit().aim.tilt_rad += 1; },
      [](State& s) { s.closed_grippers.push_back({.robot = 1, .object = {}}); },
      [](State& s) {
        s.outboxes[1].emplace().messages.push_back({0, "x"});
      },
      [](State& s) {
        s.outboxes[1].emplace().messages.push_back({kEveryOtherRobot, "x"});
      },
      [](State& s) { ++s.outboxes[1].emplace().surplus; },
      [](State& s) { s.win_requests[1] ^= 1; },
      [](State& s) {
        s.readings[1].inbox.edit().push_back({"r0", "r1", "x"});
      },
      [](State& s) { std::get<Echoes>(s.readings[1].measurements[0])[0].range_m += 1; },
      [](State& s) {
        s.found = {1, 1};
      },
      [](State& s) {
        s.won = {1, 1};
      },
      [](State& s) { s.all_halted_step = 1; },
      [](State& s) { ++s.interventions_applied; },
      [](State& s) {
        s.interventions.push_back({s.time.step, {"test", RemoveBody{"r1"}}});
      },
      [](State& s) { s.objects = ChangedObjects(std::vector<WorldObject>()); },
      [](State& s) { s.communication = Communication{}; },
      [](State& s) {
        s.additions = s.additions.with({"new", "disc", {}});
      },
      [](State& s) {
        s.ended = RunEnd{"goal", "", 1};
      },
      [](State& s) { ++s.stalls; },
      [](State& s) { ++s.messages_delivered; },
      [](State& s) { ++s.messages_dropped; },
      [](State& s) { ++s.messages_lost.in_bursts; },
      [](State& s) {
        s.messages_in_flight.push_back({0, 1, s.time.step + 1, "x"});
      },
      [](State& s) { s.digest = RunDigest(ProbeRun::kRobots); },
      [](State& s) { s.digest.reset(); },
  };
  EXPECT_EQ(State(state), state);
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    State changed = state;
    changes[i](changed);
    EXPECT_NE(changed, state) << "change " << i;
  }
}

TEST(State, OfAnotherWorldIsRefused) {
  ProbeRun run(1);
  const auto other = smallRun();
  try {
    run.environment().restore(other->state());
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "a state of 3 robots and steps of 0.100000 s does not fit a world of 9 robots and steps of 0.100000 "
                 "s, or the sensors differ; use a state of the same world");
  }
  State fewer_beams = run.environment().state();
  std::get<Echoes>(fewer_beams.readings[0].measurements[0]).pop_back();
  EXPECT_THROW(run.environment().restore(fewer_beams), std::invalid_argument);
  EXPECT_THROW(Environment(run.environment().model(), fewer_beams), std::invalid_argument);
  State slower = run.environment().state();
  slower.time.period_s = 0.2;
  EXPECT_THROW(run.environment().restore(slower), std::invalid_argument);
}

TEST(State, ReplacesCommandsThatAreNotFiniteByZero) {
  const auto run = smallRun();
  const double nan = std::nan("");
  run->setCommand(0, {.speed_mps = nan, .turn_radps = -1 / 0.0, .laser_pan_rad = static_cast<float>(nan)});
  EXPECT_EQ(run->state().commands[0], Command{});
  run->setCommand(0, {.camera_head = CameraHeadCommand{{.tilt_rad = nan}, 0.5}});
  EXPECT_EQ(run->state().commands[0], Command{});
}

}  // namespace
}  // namespace robosim
