// Components of the speed benchmarks.
#include <cmath>
#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>

#include "robosim_bench/process.h"
#include "robosim_bench/ray_caster.h"
#include "robosim_bench/ray_truth.h"
#include "robosim_bench/rounds.h"
#include "robosim_bench/targets.h"
#include "robosim_bench/workloads.h"
#include "run/local_run.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

TEST(TakeTurns, RunsEachContenderInEveryRoundAfterItsPreparation) {
  std::string order;
  const auto contender = [&](char name) {
    return Contender{.work = [&order, name] { return order += name, 1.0; }, .prepare = [&order] { order += '.'; }};
  };
  const Contender both[] = {contender('a'), contender('b')};
  EXPECT_EQ(measureAlternately(both, 0).size(), 2);
  std::string expected;
  for (std::size_t round = 0; round < kRounds; ++round) expected += ".a.b";
  EXPECT_EQ(order, expected);
}

TEST(TakeTurns, ReportsTheCostPerUnit) {
  double sum = 0;
  const auto busy = [&](double units) {
    return Contender{.work = [&sum, units] {
      for (int i = 0; i < 100000; ++i) sum += std::sqrt(static_cast<double>(i));
      return units;
    }};
  };
  const Contender both[] = {busy(1), busy(1e6)};
  const auto costs = measureAlternately(both, 0);
  EXPECT_GT(costs[0].cpu_s, 0);
  EXPECT_GE(costs[0].wall_s, costs[1].wall_s * 1000) << "a million units of the same work cost far less each";
  EXPECT_GT(sum, 0);
}

TEST(InOwnProcess, ReturnsTheFiguresWithoutSideEffects) {
  int here = 1;
  const auto figures = runInChildProcess([&]() -> nlohmann::json {
    here = 2;
    return {{"text", std::string(100000, 'x')}, {"number", 0.1}};
  });
  EXPECT_EQ(figures["text"].get<std::string>().size(), 100000);
  EXPECT_EQ(figures["number"], 0.1);
  EXPECT_EQ(here, 1);
}

std::string failureOf(const std::function<nlohmann::json()>& measure) {
  try {
    runInChildProcess(measure);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(InOwnProcess, ReportsFailuresOfTheChildProcess) {
  EXPECT_EQ(failureOf([]() -> nlohmann::json { throw std::runtime_error("it broke"); }), "it broke");
  EXPECT_EQ(failureOf([]() -> nlohmann::json { std::_Exit(3); }),
            "the measuring process crashed; check whether there is enough memory");
  EXPECT_EQ(failureOf([]() -> nlohmann::json {
              std::raise(SIGKILL);
              return {};
            }),
            "the measuring process crashed with signal 9; check whether there is enough memory");
  EXPECT_EQ(failureOf([]() -> nlohmann::json {
              std::raise(SIGINT);
              return {};
            }),
            "interrupted before all was measured");
}

TEST(Memory, MeasuresCurrentAndPeakUse) {
  const auto grown = runInChildProcess([]() -> nlohmann::json {
    const Memory before = Memory::now();
    double taken_mb = 0;
    {
      std::vector<char> block(std::size_t{64} << 20, 1);
      taken_mb = Memory::now().resident_mb - before.resident_mb;
    }
    const Memory after = Memory::now();
    return {{"taken_mb", taken_mb},
            {"kept_mb", after.resident_mb - before.resident_mb},
            {"peak_mb", after.peak_mb - before.resident_mb}};
  });
  EXPECT_NEAR(grown["taken_mb"].get<double>(), 64, 16);
  EXPECT_NEAR(grown["peak_mb"].get<double>(), 64, 16);
#ifndef __SANITIZE_ADDRESS__  // the sanitizer delays freeing of memory
  EXPECT_NEAR(grown["kept_mb"].get<double>(), 0, 4);
#endif
}

TEST(StandardWorld, IsIdenticalWhenLoadedFromItsFile) {
  const auto digest_of = [](LoadedWorld world) {
    LocalRun run(std::move(world), {});
    for (int i = 0; i < 10; ++i) run.step();
    return run.environment().digest();
  };
  for (const auto& workload : workloads()) {
    const auto file = writeWorld(emptyFolder(), workload, 30, 7);
    EXPECT_EQ(digest_of(loadWorldToRun(file, "")), digest_of(makeWorldToRun(workload, 30, 7))) << workload.name;
  }
}

TEST(StandardWorld, HasOneObjectAndAQuarterOfAWallPerRobot) {
  const LoadedWorld made = makeWorldToRun(workloadNamed("laser"), 100, 1);
  EXPECT_EQ(made.fleet.robots.size(), 100);
  EXPECT_EQ(made.world.objects.size(), 100 + 25 + 4);
  EXPECT_NEAR(made.world.bounds.x_max - made.world.bounds.x_min, 42, 1e-9) << "16 m² a robot, and walls of a metre";
  for (const auto& robot : made.fleet.robots) EXPECT_EQ(*robot.controller, "wander");
}

TEST(StandardWorld, WithInfraredRobotsHasOneRobotPerSquareMetre) {
  const LoadedWorld made = makeWorldToRun(workloadNamed("infrared"), 400, 1);
  EXPECT_NEAR(made.world.bounds.x_max - made.world.bounds.x_min, 20.5, 1e-9)
      << "20 m, and walls of a quarter of a metre";
  EXPECT_EQ(made.fleet.robots.front().model->radius_m, 0.0625);
}

// Robots that stand still would make the cost of a robot-step depend on the length of the run.
TEST(StandardWorld, RobotsOfEveryWorkloadKeepMoving) {
  constexpr std::size_t kRobots = 100;
  for (const auto& workload : workloads()) {
    LocalRun run(makeWorldToRun(workload, kRobots, 1),
                 {.environment = {.seed = 1, .period_s = 0.1, .threads = 1}, .controller = ""});
    double moved_m = 0;
    int stalled = 0;
    constexpr int kSettled = 3000;
    constexpr int kSteps = 4000;
    for (int step = 0; step < kSteps; ++step) {
      run.step();
      if (step < kSettled) continue;
      for (std::size_t robot = 0; robot < kRobots; ++robot) {
        moved_m += 0.1 * std::abs(run.environment().state().speed_mps[robot]);
        stalled += run.environment().state().stalled[robot];
      }
    }
    const double robot_steps = static_cast<double>(kRobots) * (kSteps - kSettled);
    const double mean_speed_mps = moved_m / (0.1 * robot_steps);
    EXPECT_GT(mean_speed_mps, 0.5 * 0.7 * workload.scale) << workload.name << ": half of the maximum speed";
    EXPECT_LT(stalled, 0.05 * robot_steps) << workload.name;
    RecordProperty(workload.name,
                   std::to_string(mean_speed_mps) + " m/s, stalled " + std::to_string(stalled / robot_steps));
  }
}

TEST(TakeTurns, ReadsTheClocksOfTheWorkingProcess) {
  double now_s = 0;
  const Contender elsewhere[] = {{.work = [&] { return now_s += 3, 2.0; },
                                  .clocks =
                                      [&] {
                                        return Clocks{now_s, 2 * now_s};
                                      }}};
  const Cost cost = measureAlternately(elsewhere, 0).front();
  EXPECT_EQ(cost.wall_s, 1.5) << "3 s for two units";
  EXPECT_EQ(cost.cpu_s, 3);
}

const Ray kAlongX{{0, 0, 0.5}, {1, 0, 0}};

TEST(RayTruth, MatchesDistancesComputedByHand) {
  const std::vector<Solid> solids{{Circle{{5, 0}, 1}, {0, 1}},
                                  {OrientedBox::from({0, 8, M_PI / 4}, std::sqrt(8.0), std::sqrt(8.0)), {0, 1}}};
  const RayTruth truth(solids, {kAlongX, {{0, 0, 0.5}, {0, 1, 0}}, {{0, 0, 0.5}, {-1, 0, 0}}});
  EXPECT_NEAR(truth.distance(0), 4, 1e-12);
  EXPECT_NEAR(truth.distance(1), 6, 1e-12) << "the corner of a box that stands on it";
  EXPECT_TRUE(std::isinf(truth.distance(2)));
}

TEST(RayTruth, RejectsWrongDistances) {
  const std::vector<Solid> solids{{Circle{{5, 0}, 1}, {0, 1}}};
  const RayTruth truth(solids, {kAlongX});
  EXPECT_TRUE(truth.agrees(0, 4, 8, 1e-9));
  EXPECT_TRUE(truth.agrees(0, 4.0009, 8, 1e-3));
  EXPECT_FALSE(truth.agrees(0, 4.003, 8, 1e-3));
  EXPECT_FALSE(truth.agrees(0, 3.997, 8, 1e-3));
  EXPECT_FALSE(truth.agrees(0, 8, 8, 1e-3)) << "a miss";
  EXPECT_TRUE(truth.agrees(0, 3, 3, 1e-9)) << "out of reach";
  EXPECT_FALSE(truth.agrees(0, 2.9, 3, 1e-3));
}

TEST(RayTruth, AcceptsBothDistancesOfAGrazingRay) {
  // The ray misses the first circle by 0.1 mm, and then hits the second.
  const std::vector<Solid> solids{{Circle{{5, 1.0001}, 1}, {0, 1}}, {Circle{{7, 0}, 0.5}, {0, 1}}};
  const RayTruth truth(solids, {kAlongX});
  EXPECT_NEAR(truth.distance(0), 6.5, 1e-12);
  EXPECT_TRUE(truth.agrees(0, 5, 8, 1e-3)) << "touches the first";
  EXPECT_FALSE(truth.agrees(0, 5, 8, 1e-9)) << "in double precision that is a mistake";
  EXPECT_FALSE(truth.agrees(0, 8, 8, 1e-3)) << "there is no passing the second";
}

TEST(RayScene, StartsNoRayInsideASolid) {
  const RayScene scene = makeRayScene(20, 1);
  EXPECT_EQ(scene.solids.size(), 1000);
  EXPECT_EQ(scene.beams.size(), 20 * 181);
  EXPECT_EQ(scene.singles.size(), 20 * 181);
  for (const auto* rays : {&scene.beams, &scene.singles}) {
    for (const auto& ray : *rays) {
      for (const auto& solid : scene.solids) ASSERT_GT(distance(solid.outline, {ray.origin.x, ray.origin.y}), 0);
    }
  }
  const auto& scanner = scene.world_from_scanner[3];
  const auto& beam = scene.beams[3 * 181 + 90];
  EXPECT_NEAR(beam.direction.x, std::cos(scanner.phi), 1e-12) << "the middle beam points ahead";
  EXPECT_NEAR(beam.direction.y, std::sin(scanner.phi), 1e-12);
}

/// Figures that just meet all targets.
SpeedFigures enough() {
  SpeedFigures figures;
  for (const auto& load : standardLoads()) {
    RobotFigures f;
    f.workload = load.workload->name;
    f.robots = load.robots;
    f.threads = load.threads;
    f.robot_step = {.wall_s = 1e-6, .cpu_s = 1 / 1.6e6};
    f.digest = "abc";
    figures.loads.push_back(f);
  }
  figures.rays.peer = "Embree 3";
  for (const char* what : {"scans", "single rays"}) {
    RayFigures f;
    f.what = what;
    f.peer_call = "call";
    f.range_m = 8;
    f.ray = {1e-8, 1e-8};
    f.peer_ray = {2e-8, 2e-8};
    figures.rays.figures.push_back(f);
  }
  figures.sonar_sector = {{1, 1}, {2.5, 2.5}};
  figures.some_many = {{1, 1}, {1.5, 1.5}};
  figures.one_two = {{1.7, 1}, {1, 1}};
  figures.some_loaded = {.load = {}, .rss_growth_mb = 10};
  figures.many_loaded = {.load = {5, 5}, .rss_growth_mb = 10 + 99000 * 2048.0 / (1024 * 1024)};
  const Cost plain{1.0 / 3000, 1.0 / 3000};
  figures.small_run = {.plain = plain, .rawlog = {1.3 / 3000, 1.3 / 3000}, .mcap = {1.25 / 3000, 1.25 / 3000}};
  return figures;
}

std::vector<std::string> missed(const SpeedFigures& figures) {
  std::vector<std::string> all;
  for (const auto& target : readTargets(figures)) {
    if (!target.met.value_or(false)) all.push_back(target.what + " | " + target.target + " | " + target.measured);
  }
  return all;
}

TEST(Targets, AreMetAtTheirLimits) { EXPECT_EQ(missed(enough()), std::vector<std::string>{}); }

TEST(Targets, ReportMissedTargetsWithTheirFigures) {
  SpeedFigures slow = enough();
  slow.rays.figures[1].peer_ray.cpu_s = 1.99e-8;
  slow.one_two[1].wall_s = 1.01;
  slow.small_run.rawlog.wall_s = 1.5 / 3000;
  slow.small_run.mcap.cpu_s = 1.6 / 3000;
  slow.loads.back().digest = "abd";
  EXPECT_EQ(missed(slow), (std::vector<std::string>{
                              "rays: single rays to 8 m, relative to Embree's call | ≥ 2.00 times | 1.99 times",
                              "sonar: two threads relative to one, 100,000 robots | ≥ 1.70 times | 1.68 times",
                              "opho2_1: cost of recording a rawlog, wall time | ≤ 40 % more | 50 % more",
                              "opho2_1: cost of recording MCAP, CPU time | ≤ 30 % more | 60 % more",
                              "digest with one thread and with two, every workload | the same | not the same"}));
}

TEST(Targets, CompareOnlyWithPeersMeasuredInTheSameRun) {
  SpeedFigures beside = enough();
  beside.enki.figures = {{.robots = 1000, .robot_step = {1, 1}, .peer_robot_step = {50, 60}}};
  std::vector<std::string> ratios;
  for (const auto& target : readTargets(beside)) {
    for (const char* elsewhere : {"Stage", "MVSim", "ARGoS"}) {
      EXPECT_EQ(target.what.find(elsewhere), std::string::npos) << target.what;
    }
    if (target.what.find("Enki") != std::string::npos) ratios.push_back(target.measured);
  }
  EXPECT_EQ(ratios, std::vector<std::string>{"60.0 times"}) << "CPU time of a robot-step, 60 s for 1 s";
}

TEST(Targets, AreNeitherMetNorMissedWithoutAPeer) {
  SpeedFigures alone = enough();
  alone.rays.peer.clear();
  const auto targets = readTargets(alone);
  EXPECT_EQ(targets[0].measured, "no Embree");
  EXPECT_FALSE(targets[0].met);
}

}  // namespace
}  // namespace robosim
