// Runs in which each rank knows only the robots near its own.
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "distributed/testing/crowd_runs.h"
#include "environment/testing/small_world.h"
#include "run/registry.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

/// The model of a robot with further sensors.
std::shared_ptr<const RobotModel> withSensors(const RobotModel& model, const std::vector<std::string>& sensors) {
  auto more = std::make_shared<RobotModel>(model);
  auto infos = std::make_shared<std::vector<SensorInfo>>(*model.sensor_infos);
  for (const auto& xml : sensors) {
    more->sensors.push_back(sensorFrom(xml));
    infos->push_back(more->sensors.back()->info());
  }
  more->sensor_infos = infos;
  return more;
}

struct Crowd {
  int columns = 20, rows = 15;
  double pitch_m = 1.2;
  double speed_max_mps = 3;
  std::vector<std::string> sensors{"<laser beams='24' field_of_view_deg='360' range_max_m='1.5'/>",
                                   "<range_and_bearing range_max_m='2' count='3'/>", "<bumper segments='8'/>"};
  std::string controller = "dasher";
  bool has_gold = false;
};

/// Robots in rows, each within its square, and some pillars between them.
LoadedWorld crowdedWorld(const Crowd& crowd, std::uint64_t seed) {
  addDasher();
  LoadedWorld made;
  const double half_m = crowd.pitch_m * std::max(crowd.columns, crowd.rows) / 2 + 1;
  made.world = emptyWorld(half_m);
  Rng rng(seed);
  const MotionLimits limits{crowd.speed_max_mps, 4, 20, 20, 50};
  std::shared_ptr<const RobotModel> model;
  for (int i = 0; i < crowd.rows * crowd.columns; ++i) {
    const auto place = [&](int n, int of) { return (n - (of - 1) / 2.0) * crowd.pitch_m; };
    const double x = place(i % crowd.columns, crowd.columns), y = place(i / crowd.columns, crowd.rows);
    if (rng.below(12) == 0) {
      addWall(made.world, x, y, 0.3, 0.1, rng.uniform(0, 3));
      continue;
    }
    const double off_m = std::max(0.0, crowd.pitch_m / 2 - 0.25);
    addDisc(made.world, made.fleet, "r" + std::to_string(i),
            {x + rng.uniform(-off_m, off_m), y + rng.uniform(-off_m, off_m), rng.uniform(-M_PI, M_PI)}, 0.2, limits);
    FleetRobot& robot = made.fleet.robots.back();
    if (!model) model = withSensors(*robot.model, crowd.sensors);
    robot.model = model;
    robot.info.sensors = model->sensor_infos;
    robot.controller.edit() = crowd.controller;
  }
  if (crowd.has_gold) addGold(made.world, half_m - 0.5, half_m - 0.5);
  made.world.win_distance_m = 3;
  return made;
}

constexpr RankExchange kNear = RankExchange::near;

TEST(NearExchange, GivesTheRunOfOneProcessInRandomCrowdsOfFastRobots) {
  constexpr int kSteps = 60;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const LoadedWorld world = crowdedWorld({}, seed);
    const std::string alone = resultAlone(world, kSteps);
    for (const int ranks : {2, 3, 5, 8}) {
      const OnRanks near = runOf(world, kSteps, ranks, {.balance_steps = 0, .exchange = kNear});
      EXPECT_EQ(near.exchange.find("ranks know the robots near their own: "), 0u) << near.exchange;
      EXPECT_EQ(near.result, alone) << "seed " << seed << ", " << ranks << " ranks";
    }
  }
}

TEST(NearExchange, GivesItWhileSharesMove) {
  constexpr int kSteps = 60;
  const LoadedWorld world = crowdedWorld({.columns = 12, .rows = 60}, 1);
  const std::string alone = resultAlone(world, kSteps);
  for (const std::uint64_t balance_steps : {1, 3, 10}) {
    for (const int ranks : {2, 4}) {
      EXPECT_EQ(runOf(world, kSteps, ranks, {.balance_steps = balance_steps, .exchange = kNear}).result, alone)
          << balance_steps << ", " << ranks;
    }
  }
}

TEST(NearExchange, GivesItWhenRankZeroNeedsAllReadingsOrPoses) {
  constexpr int kSteps = 40;
  const LoadedWorld world = crowdedWorld({.columns = 12, .rows = 40}, 2);
  const std::string alone = resultAlone(world, kSteps);
  for (const int ranks : {2, 3}) {
    for (const bool needs_readings : {true, false}) {
      const DistributionOptions options{.first_needs_readings = needs_readings,
                                        .balance_steps = 4,
                                        .first_needs_poses = !needs_readings,
                                        .exchange = kNear};
      const OnRanks near = runOf(world, kSteps, ranks, options);
      EXPECT_EQ(near.result, alone);
      EXPECT_EQ(near.measured[0].robots_moved, world.fleet.robots.size() * kSteps);
    }
  }
}

TEST(NearExchange, GivesItWithRobotsThatDriveThroughTheOtherRanksShare) {
  // Rank 0's 256 robots start below those of rank 1, drive up between them, and leave them behind.
  constexpr int kSteps = 300;
  struct Upwards : Controller {
    void step(Robot& robot) override { robot.drive(robot.name()[0] == 'u' ? 3 : 0, 0); }
  };
  Registry registry;
  registry.controllers.add(
      {"upwards", "Drives ahead.", {}, {}, [](const auto&, const auto&) { return std::make_unique<Upwards>(); }});
  addToProgram(registry);
  LoadedWorld made;
  made.world = emptyWorld(64);
  for (int i = 0; i < 512; ++i) {
    const bool drives = i < 256;
    const double x = (i % 64 - 32) * 1.5 + (drives ? 0 : 0.75), y = (drives ? -60 : -20) + (i % 256) / 64 * 1.5;
    addDisc(made.world, made.fleet, (drives ? "u" : "s") + std::to_string(i), {x, y, M_PI_2}, 0.2, {3, 4, 20, 20, 50});
    FleetRobot& robot = made.fleet.robots.back();
    robot.model = withSensors(*robot.model, {"<laser beams='8' field_of_view_deg='360' range_max_m='2'/>"});
    robot.info.sensors = robot.model->sensor_infos;
    robot.controller.edit() = "upwards";
  }
  const std::string alone = resultAlone(made, kSteps);
  const OnRanks near = runOf(made, kSteps, 2, {.balance_steps = 0});
  EXPECT_EQ(near.result, alone);
  EXPECT_EQ(near.exchange.find("ranks know the robots near their own: 0.0 %"), 0u) << near.exchange;
  // None at first and at last, and all 256 of the other rank in between.
  for (const auto& rank : near.measured) {
    EXPECT_GT(rank.robots_moved, 256u * kSteps * 11 / 10);
    EXPECT_LT(rank.robots_moved, 256u * kSteps * 15 / 10);
  }
}

TEST(NearExchange, DecidesTheWinnerFromPosesThatOtherRanksDoNotKnow) {
  // Whether a robot comes near the gold depends on the dashers' broadcasts, at which all turn: with them the first seed
  // has a winner but the third has none; without them the third has one.
  constexpr int kSteps = 400;
  const LoadedWorld world = crowdedWorld({.has_gold = true}, 1);
  const std::string alone = resultAlone(world, kSteps);
  ASSERT_NE(alone.substr(0, alone.find('\n')).find(" r"), std::string::npos) << "no robot has won";
  EXPECT_EQ(runOf(world, kSteps, 5, {.balance_steps = 9, .exchange = kNear}).result, alone);
}

TEST(NearExchange, IsOfAFractionOfTheRobotsAndBytes) {
  // 64 rows of 64 robots, 2 m apart, divided among 4 ranks. They see 3 m, up to a robot's edge: centres are up to 3.2 m
  // apart, and approach by half of that within 8 steps of 2 x 0.1 m. Ranks know the robots up to 4.8 m from theirs at
  // each of the 3 borders, from either side: 2 rows, and one more since cells are 2.4 m wide and robots up to 0.75 m
  // off their rows.
  constexpr int kSteps = 16;
  const Crowd crowd{.columns = 64,
                    .rows = 64,
                    .pitch_m = 2,
                    .speed_max_mps = 1,
                    .sensors = {"<laser beams='8' field_of_view_deg='360' range_max_m='3'/>"}};
  LoadedWorld world = crowdedWorld(crowd, 1);
  const double robots = static_cast<double>(world.fleet.robots.size());
  const OnRanks near = runOf(world, kSteps, 4, {.balance_steps = 0});
  const OnRanks all = runOf(world, kSteps, 4, {.balance_steps = 0, .exchange = RankExchange::all});
  EXPECT_EQ(near.result, all.result);
  EXPECT_EQ(all.exchange, "ranks know all robots: as requested");
  std::uint64_t near_bytes = 0, all_bytes = 0;
  double moved = 0;
  for (std::size_t rank = 0; rank < 4; ++rank) {
    EXPECT_EQ(all.measured[rank].robots_moved, world.fleet.robots.size() * kSteps);
    moved += static_cast<double>(near.measured[rank].robots_moved);
    near_bytes += near.measured[rank].bytes_received;
    all_bytes += all.measured[rank].bytes_received;
  }
  const double rows = moved / kSteps / (robots / 64);
  EXPECT_GT(rows, 64 + 2 * 3 * 2);
  EXPECT_LT(rows, 64 + 2 * 3 * 4);
  EXPECT_LT(near_bytes, all_bytes / 3);
}

TEST(NearExchange, IsChosenByTheRobotsThatRanksKnowWithoutNeedingAll) {
  // Two ranks in a world of 40 rows, of which each knows 3 to 4 of the other rank's 20. Rank 0 records the run.
  const LoadedWorld world = crowdedWorld({.columns = 13, .rows = 40}, 2);
  for (const auto& options : {DistributionOptions{.first_needs_readings = true, .balance_steps = 0},
                              DistributionOptions{.balance_steps = 0, .first_needs_poses = true}}) {
    const OnRanks chosen = runOf(world, 5, 2, options);
    EXPECT_EQ(chosen.exchange.find("ranks know the robots near their own: "), 0u) << chosen.exchange;
    EXPECT_NE(chosen.exchange.find(" m of a rank's own (without rank 0, which needs all)"), std::string::npos);
    EXPECT_EQ(chosen.measured[0].robots_moved, world.fleet.robots.size() * 5);
    EXPECT_LT(chosen.measured[1].robots_moved, world.fleet.robots.size() * 5 * 7 / 10);
  }
}

TEST(NearExchange, SendsAMessageOnceToAllRanks) {
  struct Caller : Controller {
    void step(Robot& robot) override {
      if (robot.name() == "r0") robot.send(robot.robots().back(), std::string(4000, 'x'));
    }
  };
  Registry registry;
  registry.controllers.add(
      {"caller", "Sends.", {}, {}, [](const auto&, const auto&) { return std::make_unique<Caller>(); }});
  addToProgram(registry);
  LoadedWorld made;
  made.world = emptyWorld(200);
  for (int i = 0; i < 500; ++i) {
    addDisc(made.world, made.fleet, "r" + std::to_string(i), {i % 10 * 4.0 - 20, i / 10 * 4.0 - 100, 0});
    made.fleet.robots.back().controller.edit() = "caller";
  }
  const OnRanks near = runOf(made, 10, 5, {.balance_steps = 0, .exchange = kNear});
  EXPECT_EQ(near.exchange.find("ranks know the robots near their own: "), 0u) << near.exchange;
  EXPECT_EQ(near.result, resultAlone(made, 10));
  // Ten messages, and the motion of near robots; not four times as much.
  EXPECT_GT(near.measured[0].bytes_sent, 40'000u);
  EXPECT_LT(near.measured[0].bytes_sent, 80'000u);
  for (std::size_t rank = 1; rank < 5; ++rank) EXPECT_GT(near.measured[rank].bytes_received, 40'000u) << rank;
}

TEST(NearExchange, FallsBackToAllRobotsWhereNearOnesDoNotSuffice) {
  constexpr int kSteps = 20;
  LoadedWorld world = crowdedWorld({}, 1);
  world.world.communication.range_m = 4;
  const OnRanks radio = runOf(world, kSteps, 3, {.balance_steps = 0, .exchange = kNear});
  EXPECT_EQ(radio.exchange, "ranks know all robots: messages depend on the positions of their senders and receivers");
  EXPECT_EQ(radio.result, resultAlone(world, kSteps));
  world = crowdedWorld({.columns = 8, .rows = 8}, 1);
  const OnRanks dense = runOf(world, kSteps, 8, {.balance_steps = 0});
  EXPECT_NE(dense.exchange.find("ranks know all robots: "), std::string::npos) << dense.exchange;
  EXPECT_NE(dense.exchange.find(" % of the robots of other ranks are within "), std::string::npos);
  EXPECT_EQ(dense.result, resultAlone(world, kSteps));
  EXPECT_EQ(runOf(world, kSteps, 1, {.exchange = kNear}).exchange, "ranks know all robots: there is one rank");
}

}  // namespace
}  // namespace robosim
