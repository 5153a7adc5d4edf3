// A step computed in parts by replicas is identical to that of one environment, bit for bit.
#include <gtest/gtest.h>

#include "environment/step_phases.h"
#include "run/local_run.h"

namespace robosim {
namespace {

const char* const kOpenWorld = ROBOSIM_SOURCE_DIR "/worlds/open_100.xml";
constexpr int kSharedSteps = 120;

LocalRun startRun() { return {loadWorld(kOpenWorld, checkController), RunOptions{}}; }

std::string digestAlone() {
  LocalRun run = startRun();
  for (int i = 0; i < kSharedSteps; ++i) run.step();
  return run.environment().digest();
}

/// Applies the results of another environment for some robots.
void takeClips(Environment& from, Environment& to, RobotRange range) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    to.phases().results().paths[i].end_fraction = from.phases().results().paths[i].end_fraction;
  }
}
void takeStays(Environment& from, Environment& to, RobotRange range) {
  for (std::size_t i = range.begin; i < range.end; ++i)
    to.phases().results().stays[i] = from.phases().results().stays[i];
}
void takeReadings(Environment& from, Environment& to, RobotRange range) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const auto& sensors = to.fleet().robots[i].model->sensors;
    for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
      if (sensors[slot]->sensesInHostProcess()) continue;
      to.phases().results().readings[i].measurements[slot] = from.phases().results().readings[i].measurements[slot];
    }
  }
}

/// A step in which the replica computes the robots of `share`, and the owner all others.
void stepTogether(Environment& owner, Environment& replica, RobotRange share) {
  const RobotRange every{0, owner.robotCount()};
  const RobotRange others[] = {{0, share.begin}, {share.end, every.end}};
  owner.phases().begin();
  for (std::size_t i = 0; i < every.end; ++i) replica.setCommand(i, owner.state().commands[i]);
  replica.phases().begin();

  replica.phases().clip(share);
  for (const auto range : others) owner.phases().clip(range);
  takeClips(replica, owner, share);
  for (const auto range : others) takeClips(owner, replica, range);

  replica.phases().judge(share);
  for (const auto range : others) owner.phases().judge(range);
  takeStays(replica, owner, share);
  for (const auto range : others) takeStays(owner, replica, range);

  owner.phases().move();
  replica.phases().move();
  replica.phases().sense(share);
  for (const auto range : others) owner.phases().sense(range);
  takeReadings(replica, owner, share);
  owner.phases().finish();
}

TEST(SharedStep, IsIdenticalForAnyPartition) {
  LocalRun run = startRun();
  Environment& owner = run.environment();
  // The replica receives the state when it joins, during the run.
  LoadedWorld world = loadWorld(kOpenWorld, checkController);
  Environment replica(std::move(world.world), std::move(world.fleet), EnvironmentOptions{});
  for (int i = 0; i < kSharedSteps; ++i) {
    run.decide();
    if (i < 20) {
      owner.step();
      continue;
    }
    if (i == 20) replica.restore(owner.state());
    const std::size_t begin = static_cast<std::size_t>(i) % 60;
    stepTogether(owner, replica, {begin, begin + 40});
  }
  EXPECT_EQ(owner.digest(), digestAlone());
}

}  // namespace
}  // namespace robosim
