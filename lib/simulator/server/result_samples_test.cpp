#include "server/result_samples.h"

#include <set>

#include <gtest/gtest.h>

#include "environment/step_phases.h"
#include "robots/world_source.h"

namespace robosim {
namespace {

std::unique_ptr<Environment> openWorld() {
  LoadedWorld world = loadWorld(ROBOSIM_SOURCE_DIR "/worlds/open_100.xml", {});
  return std::make_unique<Environment>(std::move(world.world), std::move(world.fleet), EnvironmentOptions{});
}

std::vector<std::size_t> robotsOf(const std::vector<ResultSamples::Expected>& sample) {
  std::vector<std::size_t> robots;
  for (const auto& expected : sample) robots.push_back(expected.robot);
  return robots;
}

TEST(ResultSamples, HaveTheRequestedFractionAndAtLeastOneRobot) {
  const auto environment = openWorld();
  EXPECT_EQ(ResultSamples(0, 1).compute(*environment, {10, 90}, 1).size(), 1u);
  EXPECT_EQ(ResultSamples(0.05, 1).compute(*environment, {10, 90}, 1).size(), 4u) << "of 80";
  EXPECT_EQ(ResultSamples(1, 1).compute(*environment, {10, 90}, 1).size(), 80u);
}

TEST(ResultSamples, ReachEachRobotOfTheShareAndNoOther) {
  const auto environment = openWorld();
  const ResultSamples samples(0, 42);
  std::set<std::size_t> chosen;
  for (int step = 0; step < 400; ++step) {
    environment->phases().begin();  // the choice depends on the step
    for (const auto robot : robotsOf(samples.compute(*environment, {20, 40}, 7))) chosen.insert(robot);
  }
  // Of 400 draws from 20 robots a given one is missing with a probability of 0.95^400 = 1e-9.
  EXPECT_EQ(chosen.size(), 20u);
  EXPECT_EQ(*chosen.begin(), 20u);
  EXPECT_EQ(*chosen.rbegin(), 39u);
}

TEST(ResultSamples, DifferBySecretAndWorker) {
  const auto environment = openWorld();
  std::set<std::size_t> by_secret, by_worker;
  for (std::uint64_t k = 0; k < 20; ++k) {
    by_secret.insert(robotsOf(ResultSamples(0, k).compute(*environment, {0, 100}, 1))[0]);
    by_worker.insert(robotsOf(ResultSamples(0, 1).compute(*environment, {0, 100}, k))[0]);
  }
  EXPECT_GT(by_secret.size(), 5u);
  EXPECT_GT(by_worker.size(), 5u);
}

TEST(ResultSamples, FindAMeasurementThatDiffersInOneBit) {
  const auto environment = openWorld();
  const auto sample = ResultSamples(1, 1).compute(*environment, {0, 10}, 1);
  EXPECT_EQ(ResultSamples::firstDifference(sample, *environment), std::nullopt);
  auto& echo = std::get<Echoes>(environment->phases().results().readings[6].measurements[0])[0];
  echo.point_m.z = std::nextafter(echo.point_m.z, 1e3f);
  EXPECT_EQ(ResultSamples::firstDifference(sample, *environment), 6u);
}

}  // namespace
}  // namespace robosim
