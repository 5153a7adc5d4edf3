// With all errors of all sensors and of the radio, a run does not depend on threads, on the processes that compute it,
// or on being saved.
#include <gtest/gtest.h>

#include "environment/state_bytes.h"
#include "environment/step_phases.h"
#include "environment/testing/probe_run.h"

namespace robosim {
namespace {

constexpr std::uint32_t kErrorSteps = 80;

/// The digest of a run with all errors, computed by one thread.
std::string digestAlone(std::uint64_t seed) {
  ProbeRun run(seed);
  for (std::uint32_t i = 0; i < kErrorSteps; ++i) run.step();
  return run.environment().digest();
}

TEST(ErrorModels, AreIndependentOfThreads) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    ProbeRun run(seed);
    const std::string expected = digestAlone(seed);
    for (const int threads : {2, 3}) {
      const auto other = run.another(threads);
      other->restart(initialState(*other->model()));
      for (std::uint32_t i = 0; i < kErrorSteps; ++i) run.step(*other);
      EXPECT_EQ(other->digest(), expected) << threads << " threads, seed " << seed;
    }
  }
}

TEST(ErrorModels, AreIndependentOfSavingAndLoading) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    ProbeRun run(seed);
    for (std::uint32_t i = 0; i < kErrorSteps; ++i) {
      // Another environment continues after each seventh step.
      if (i % 7 == 3) {
        const auto other = run.another();
        other->restore(stateFromBytes(*other->model(), toBytes(*other->model(), run.environment().state())));
        run.step(*other);
        run.environment().restore(other->state());
      } else {
        run.step();
      }
    }
    EXPECT_EQ(run.environment().digest(), digestAlone(seed)) << seed;
  }
}

/// Takes a step in which a replica measures the first robots. It has the state before, as a worker, without readings.
void stepTogether(Environment& owner, Environment& replica, std::size_t robots) {
  State state = owner.state();
  const State blank = initialState(*owner.model());
  for (std::size_t i = 0; i < state.readings.size(); ++i) {
    state.readings[i].measurements = blank.readings[i].measurements;
  }
  replica.restore(state);
  const RobotRange every{0, owner.robotCount()};
  for (Environment* environment : {&owner, &replica}) {
    environment->phases().begin();
    environment->phases().clip(every);
    environment->phases().judge(every);
    environment->phases().move();
  }
  replica.phases().sense({0, robots});
  owner.phases().sense({robots, every.end});
  for (std::size_t i = 0; i < robots; ++i) {
    const auto& sensors = owner.fleet().robots[i].model->sensors;
    for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
      if (sensors[slot]->sensesInHostProcess()) continue;
      owner.phases().results().readings[i].measurements[slot] =
          replica.phases().results().readings[i].measurements[slot];
    }
  }
  owner.phases().finish();
}

TEST(ErrorModels, AreIndependentOfTheProcessThatSenses) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    ProbeRun run(seed);
    Environment& owner = run.environment();
    const auto replica = run.another();
    for (std::uint32_t i = 0; i < kErrorSteps; ++i) {
      run.prepare(owner);
      stepTogether(owner, *replica, 5);
    }
    EXPECT_EQ(owner.digest(), digestAlone(seed)) << seed;
  }
}

}  // namespace
}  // namespace robosim
