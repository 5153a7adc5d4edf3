#include "distributed/distributed_run.h"

#include <functional>
#include <mutex>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/random.h"
#include "distributed/ranks/testing/thread_ranks.h"
#include "distributed/run_identity.h"
#include "environment/testing/small_world.h"
#include "maze/controllers.h"

namespace robosim {
namespace {

std::string shipped(const std::string& name) { return ROBOSIM_SOURCE_DIR "/worlds/" + name + ".xml"; }

struct Settings {
  std::string world;
  std::string controller = {};
  int steps = 100;
  std::vector<std::string> observers = {};
  std::vector<TimedChange> timeline = {};
  bool has_movable_objects = false;  ///< all but walls, and low
};

LoadedWorld loaded(const Settings& settings) {
  LoadedWorld world = loadWorldToRun(shipped(settings.world), settings.controller);
  world.world.timeline = settings.timeline;
  for (auto& object : world.world.objects) {
    if (!settings.has_movable_objects || object.body.coveringRadius() > 1) continue;
    object.movable = Movable{.mass_kg = 1, .friction = 0.1, .restitution = 0.5};
    object.body.center_z_m = 0.05;  // lower than the robots' sensors, which would avoid it
    object.body.height_m = 0.1;
  }
  return world;
}

RunOptions optionsOf(const Settings& settings, int threads) {
  RunOptions options;
  options.environment.threads = threads;
  options.controller = settings.controller;
  options.observers = settings.observers;
  options.observers_log = false;
  return options;
}

/// All that a run on several ranks must have in common with one in one process.
std::string outcomeOf(const LocalRun& run, bool with_readings) {
  const State& state = run.environment().state();
  std::ostringstream text;
  text << run.environment().digest() << ' ' << state.time.step << ' ' << run.dependsOnSeed() << ' ' << state.stalls
       << ' ' << state.messages_delivered << ' ' << state.messages_dropped << ' ' << state.messages_lost.total() << ' '
       << messagesSent(state) << ' ' << run.gold().found_by.value_or("-") << ' '
       << run.gold().all_halted_s.value_or(-1);
  for (std::size_t i = 0; i < state.readings.size(); ++i) {
    const auto& pose = state.world_from_robot[i];
    text << '\n' << pose.x << ' ' << pose.y << ' ' << pose.phi << ' ' << state.driven_m[i];
    if (with_readings) text << ' ' << state.readings[i].measurements.size() << ' ' << state.readings[i].inbox.size();
  }
  for (const auto& metric : run.observers().metrics()) text << '\n' << metric.name << ' ' << metric.value;
  if (run.observers().end()) text << run.observers().end()->reason;
  return text.str();
}

std::string outcomeAlone(const Settings& settings) {
  LocalRun run(loaded(settings), optionsOf(settings, 1));
  for (int i = 0; i < settings.steps && !run.isOver(); ++i) run.step();
  return outcomeOf(run, true);
}

std::string outcomeOnRanks(const Settings& settings, int ranks, int threads, std::uint64_t balance_steps,
                           bool first_needs_readings = true) {
  std::string outcome;
  runThreadRanks(ranks, [&](RankGroup& group) {
    DistributedRun run(group, loaded(settings), optionsOf(settings, threads), {first_needs_readings, balance_steps});
    for (int i = 0; i < settings.steps && !run.isOver(); ++i) run.step(false, nullptr);
    run.finish(nullptr);
    if (group.isFirst()) outcome = outcomeOf(run.run(), first_needs_readings);
  });
  return outcome;
}

TEST(DistributedRun, EqualsARunInOneProcessForAnyNumberOfRanksAndThreads) {
  for (const Settings& settings :
       {Settings{"open_100"}, Settings{"small_maze", "", 400}, Settings{"opho2_1"}, Settings{"maze_20x20", "", 60}}) {
    const std::string alone = outcomeAlone(settings);
    for (const int ranks : {1, 2, 3, 5, 8}) {
      EXPECT_EQ(outcomeOnRanks(settings, ranks, 1 + ranks % 3, 7), alone) << settings.world << ", " << ranks;
    }
  }
}

TEST(DistributedRun, EqualsItWhileMovesAndSensorsAreDividedAgainAfterEachStep) {
  const Settings settings{"open_100", "", 150};
  const std::string alone = outcomeAlone(settings);
  for (const int ranks : {2, 4}) EXPECT_EQ(outcomeOnRanks(settings, ranks, 1, 1), alone);
}

TEST(DistributedRun, HasTheSameDigestWithoutTheReadingsOfOtherRanks) {
  const Settings settings{"open_100"};
  const auto first_line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  EXPECT_EQ(first_line(outcomeOnRanks(settings, 3, 1, 5, false)), first_line(outcomeAlone(settings)));
  runThreadRanks(3, [&](RankGroup& group) {
    DistributedRun run(group, loaded(settings), optionsOf(settings, 1), {false, 0});
    run.step(false, nullptr);
    std::size_t with_measurements = 0;
    for (const auto& readings : run.run().environment().state().readings)
      with_measurements += readings.measurements.empty() ? 0 : 1;
    // All 100 are in one chunk of the digest, which rank 0 computes.
    const std::size_t expected = group.isFirst() ? 100 : group.rank() == 1 ? 33 : 34;
    if (with_measurements != expected) throw std::logic_error(std::to_string(with_measurements));
  });
}

TEST(DistributedRun, IsEndedOnAllRanksByAnObserverOnTheFirst) {
  const Settings settings{"open_100", "wander", 300, {"coverage end_percent=1"}};
  const std::string alone = outcomeAlone(settings);
  ASSERT_NE(alone.find("covered"), std::string::npos) << alone;
  EXPECT_EQ(outcomeOnRanks(settings, 3, 1, 10), alone);
}

/// Takes objects and robots elsewhere in every tenth step, and ends the run in step 65.
class Rearranging : public Observer {
 public:
  void observe(const Environment&) override {}
  void supervise(Supervisor& supervisor) override {
    const auto step = supervisor.environment().time().step;
    if (step == 65) static_cast<void>(supervisor.apply(EndRun{"rearranged"}));
    if (step % 10 != 0) return;
    Rng rng(1, RandomPurpose::test, 0, 0, step);
    const auto& robots = supervisor.environment().robotNames();
    const Bounds2D& surface = supervisor.environment().world().bounds;
    for (int i = 0; i < 20; ++i) {
      const auto& objects = supervisor.environment().objects();
      const bool is_robot = objects.empty() || rng.below(2) == 0;
      const std::string name = is_robot ? robots[rng.below(static_cast<std::uint32_t>(robots.size()))]
                                        : objects[rng.below(static_cast<std::uint32_t>(objects.size()))].name;
      static_cast<void>(supervisor.apply(PlaceBody{name, rng.uniform(surface.x_min, surface.x_max),
                                                   rng.uniform(surface.y_min, surface.y_max), rng.uniform(-3, 3)}));
    }
  }
};

TEST(DistributedRun, EqualsARunInOneProcessWhoseObserverRearrangesTheWorld) {
  ObserverType type{"rearranging", "Rearranges the world.", {}, [](const ObserverSetup&, const ParameterValues&) {
                      return std::unique_ptr<Observer>(std::make_unique<Rearranging>());
                    }};
  type.supervises = true;
  observers().add(type);
  for (const char* world : {"open_100", "small_maze"}) {
    const Settings settings{world, "wander", 100, {"rearranging"}};
    LocalRun run(loaded(settings), optionsOf(settings, 1));
    while (!run.isOver()) run.step();
    EXPECT_EQ(run.environment().time().step, 65u);
    EXPECT_GT(run.environment().state().interventions_applied, 10u) << world;
    const std::string alone = outcomeOf(run, true);
    for (const int ranks : {1, 2, 3, 8}) EXPECT_EQ(outcomeOnRanks(settings, ranks, 1 + ranks % 2, 7), alone) << ranks;
  }
}

TEST(DistributedRun, EqualsARunInOneProcessWhoseWorldFileChangesTheWorld) {
  Settings settings{"open_100", "wander", 60};
  settings.timeline = {{1, PlaceBody{loaded(settings).fleet.robots[7].info.name, 0.1, 0.2}, {}},
                       {2, RemoveBody{loaded(settings).fleet.robots[50].info.name}, {}}};
  LocalRun run(loaded(settings), optionsOf(settings, 1));
  for (int i = 0; i < settings.steps; ++i) run.step();
  EXPECT_EQ(run.environment().state().interventions_applied, 2u);
  const std::string alone = outcomeOf(run, true);
  for (const int ranks : {2, 5})
    EXPECT_EQ(outcomeOnRanks(settings, ranks, 1, 7, false), outcomeOf(run, false)) << ranks;
  EXPECT_EQ(outcomeOnRanks(settings, 3, 2, 7), alone);
}

/// A robot of small_maze or open_100, near a corner.
AddRobot addedNear(double x_m, double y_m, const std::string& name, const std::string& controller) {
  AddRobot add{name, "scout", {}};
  add.world_from_robot = {x_m, y_m, 1};
  add.controller = controller;
  return add;
}

TEST(DistributedRun, EqualsARunInOneProcessWhoseWorldFileAddsRobots) {
  Settings settings{"open_100", "wander", 60};
  settings.timeline = {{1, addedNear(0.3, 0.3, "First", ""), {}},
                       {2, addedNear(0.3, 1.5, "Second", "gold_finder"), {}},
                       {3, RemoveBody{"First"}, {}}};
  LocalRun run(loaded(settings), optionsOf(settings, 1));
  for (int i = 0; i < settings.steps; ++i) run.step();
  ASSERT_EQ(run.environment().state().interventions_applied, 3u);
  ASSERT_EQ(run.environment().robotCount(), 102u);
  ASSERT_GT(run.environment().state().driven_m[101], 0.5) << "its controller drives it";
  const std::string alone = outcomeOf(run, true);
  for (const int ranks : {1, 2, 3, 4, 5, 6, 7, 8})
    EXPECT_EQ(outcomeOnRanks(settings, ranks, 1 + ranks % 2, 7), alone) << ranks;
  EXPECT_EQ(outcomeOnRanks(settings, 3, 1, 1, false), outcomeOf(run, false));
}

/// Tries to add a robot anywhere in every third step.
class Adding final : public Observer {
 public:
  void observe(const Environment&) override {}
  void supervise(Supervisor& supervisor) override {
    const auto step = supervisor.environment().time().step;
    if (step % 3 != 0) return;
    Rng rng(1, RandomPurpose::test, 0, 0, step);
    const Bounds2D& surface = supervisor.environment().world().bounds;
    static_cast<void>(
        supervisor.apply(addedNear(rng.uniform(surface.x_min, surface.x_max), rng.uniform(surface.y_min, surface.y_max),
                                   std::to_string(step), "wander")));
  }
};

TEST(DistributedRun, EqualsARunInOneProcessWhoseObserverAddsRobots) {
  ObserverType type{"adding", "Adds robots.", {}, [](const ObserverSetup&, const ParameterValues&) {
                      return std::unique_ptr<Observer>(std::make_unique<Adding>());
                    }};
  type.supervises = true;
  observers().add(type);
  for (const char* world : {"open_100", "small_maze"}) {
    const Settings settings{world, "wander", 40, {"adding"}};
    LocalRun run(loaded(settings), optionsOf(settings, 1));
    const std::size_t at_start = run.environment().robotCount();
    for (int i = 0; i < settings.steps; ++i) run.step();
    ASSERT_GE(run.environment().robotCount(), at_start + 2) << world;
    const std::string alone = outcomeOf(run, true);
    for (const int ranks : {1, 2, 3, 8}) EXPECT_EQ(outcomeOnRanks(settings, ranks, 1 + ranks % 2, 7), alone) << ranks;
  }
}

TEST(DistributedRun, EndsOnAllRanksWhenTheControllerOfAnAddedRobotCannotBeMade) {
  controllers().add({"unmakeable", "Cannot be made.", {}, {}, [](const ControllerSetup&, const ParameterValues&) {
                       throw std::runtime_error("made of nothing");
                       return std::unique_ptr<Controller>();
                     }});
  Settings settings{"open_100", "wander", 20};
  settings.timeline = {{1, addedNear(0.3, 0.3, "New", "unmakeable"), {}}};
  for (const int ranks : {1, 3}) {
    try {
      outcomeOnRanks(settings, ranks, 1, 7);
      FAIL() << ranks;
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find("made of nothing"), std::string::npos) << error.what();
    }
  }
}

TEST(DistributedRun, EqualsARunInOneProcessWhoseRobotsPushObjects) {
  for (const char* world : {"open_100", "pucks", "station"}) {
    Settings settings{world, "wander", 100};
    settings.has_movable_objects = true;
    LocalRun run(loaded(settings), optionsOf(settings, 1));
    for (int i = 0; i < settings.steps; ++i) run.step();
    EXPECT_TRUE(run.environment().state().objects.areChanged()) << world << ": no robot has pushed anything";
    const std::string alone = outcomeOf(run, true);
    for (const int ranks : {1, 2, 3, 4}) EXPECT_EQ(outcomeOnRanks(settings, ranks, 1 + ranks % 2, 7), alone) << ranks;
  }
}

TEST(DistributedRun, EndsOnAllRanksAfterTheStepInWhichOneRequestsIt) {
  const Settings settings{"open_100"};
  runThreadRanks(3, [&](RankGroup& group) {
    DistributedRun run(group, loaded(settings), optionsOf(settings, 1), {});
    for (int i = 0; i < 5; ++i) run.step(false, nullptr);
    if (run.isEndRequested()) throw std::logic_error("early");
    run.step(group.rank() == 2, nullptr);
    if (!run.isEndRequested()) throw std::logic_error("not requested");
  });
}

TEST(DistributedRun, ThrowsOnAllRanksTheFailureOfOne) {
  const Settings settings{"open_100"};
  int failed = 0;
  std::mutex mutex;
  runThreadRanks(3, [&](RankGroup& group) {
    DistributedRun run(group, loaded(settings), optionsOf(settings, 1), {});
    run.step(false, nullptr);
    try {
      run.step(false, group.isFirst() ? std::make_exception_ptr(std::runtime_error("full")) : nullptr);
    } catch (const std::runtime_error& error) {
      const std::lock_guard lock(mutex);
      failed += std::string(error.what()) == "full" ? 1 : 0;
    }
  });
  EXPECT_EQ(failed, 3);
}

/// A sensor whose electronics fail in step 5 of the world's last robot.
class FailingSensor : public Sensor {
 public:
  FailingSensor() {
    info_.kind = SensorKind::values;
    info_.label = "failing";
    info_.quantities = {{"current", "A"}};
  }
  const SensorInfo& info() const override { return info_; }
  bool usesNeighbours() const override { return false; }
  double robotReach(double) const override { return 0; }
  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t,
             std::span<Readings>) const override {
    for (const auto robot : robots) {
      if (robot + 1 == now.world_from_robot.size() && now.time.step == 5) throw std::runtime_error("no current");
    }
  }

 private:
  SensorInfo info_;
};

/// Adds a FailingSensor to all robots of a world.
LoadedWorld withFailingSensor(LoadedWorld world) {
  for (FleetRobot& robot : world.fleet.robots) {
    auto model = std::make_shared<RobotModel>(*robot.model);
    auto infos = std::make_shared<std::vector<SensorInfo>>(*robot.info.sensors);
    model->sensors.push_back(std::make_shared<FailingSensor>());
    infos->push_back(model->sensors.back()->info());
    model->sensor_infos = infos;
    robot.model = model;
    robot.info.sensors = infos;
  }
  return world;
}

TEST(DistributedRun, ThrowsOnAllRanksTheFailureOfASensor) {
  const LoadedWorld world = withFailingSensor(loaded({"open_100"}));
  for (const RankExchange exchange : {RankExchange::all, RankExchange::near}) {
    for (const bool first_needs_readings : {true, false}) {
      int failed = 0;
      std::mutex mutex;
      runThreadRanks(3, [&](RankGroup& group) {
        DistributedRun run(group, world, optionsOf({"open_100"}, 1),
                           {.first_needs_readings = first_needs_readings, .exchange = exchange});
        std::uint64_t steps = 0;  // complete ones
        std::string what;
        try {
          for (; steps < 9; ++steps) run.step(false, nullptr);
        } catch (const std::runtime_error& error) {
          what = error.what();
        }
        // In one process, too, the fifth step fails. All 100 robots are in one chunk of the digest, so that rank 0
        // needs all readings in any case.
        EXPECT_EQ(steps, 4u);
        EXPECT_EQ(what, group.rank() == 2 ? "no current" : "no current (on rank 2)");
        const std::lock_guard lock(mutex);
        ++failed;
      });
      EXPECT_EQ(failed, 3);
    }
  }
}

TEST(DistributedRun, ThrowsTheFailureOfASensorAtItsEndIfNoRankNeedsReadingsOfOthers) {
  // Two whole chunks of the digest, one per rank.
  LoadedWorld world{emptyWorld(20), {}};
  for (int i = 0; i < 512; ++i)
    addDisc(world.world, world.fleet, "r" + std::to_string(i), {i % 32 - 16.0, i / 32 - 8.0, 0});
  for (FleetRobot& robot : world.fleet.robots) robot.controller.edit() = "random_walk";
  world = withFailingSensor(std::move(world));
  for (const int steps : {5, 6}) {
    int failed = 0;
    std::mutex mutex;
    runThreadRanks(2, [&](RankGroup& group) {
      DistributedRun run(group, world, {}, {.balance_steps = 0});
      std::string what;
      try {
        for (int i = 0; i < steps; ++i) run.step(false, nullptr);
        run.finish(nullptr);
      } catch (const std::runtime_error& error) {
        what = error.what();
      }
      EXPECT_EQ(what, group.rank() == 1 ? "no current" : "no current (on rank 1)");
      const std::lock_guard lock(mutex);
      ++failed;
    });
    EXPECT_EQ(failed, 2);
  }
}

/// The errors by which two ranks refuse a run; empty for none. @param change of what rank 1 is given
std::vector<std::string> refusalsOf(
    const std::function<void(LoadedWorld&, RunOptions&, DistributionOptions&)>& change) {
  std::vector<std::string> errors;
  std::mutex mutex;
  runThreadRanks(2, [&](RankGroup& group) {
    const Settings settings{"open_100"};
    LoadedWorld world = loaded(settings);
    RunOptions options = optionsOf(settings, 1 + group.rank());
    DistributionOptions distribution;
    if (!group.isFirst()) change(world, options, distribution);
    try {
      DistributedRun run(group, std::move(world), options, distribution);
    } catch (const ConfigError& error) {
      const std::lock_guard lock(mutex);
      errors.emplace_back(error.what());
    }
  });
  return errors;
}

TEST(DistributedRun, RefusesWorldsThatDifferBetweenRanks) {
  const auto expect_refused = [](const std::string& text, const auto& change) {
    const auto errors = refusalsOf(change);
    ASSERT_EQ(errors.size(), 2u) << text;
    for (const auto& error : errors) EXPECT_EQ(error.find(text), 0u) << error;
  };
  EXPECT_EQ(refusalsOf([](auto&, auto&, auto&) {}).size(), 0u);
  const std::string another_world = "this process has read another world than rank 0";
  expect_refused(another_world, [](auto& world, auto&, auto&) { world = loaded({"small_maze"}); });
  expect_refused(another_world, [](auto&, auto& options, auto&) { options.environment.seed = 2; });
  const std::string other_controllers = "this process has read a world with other controllers, neighbours or types";
  expect_refused(other_controllers,
                 [](auto& world, auto&, auto&) { world.fleet.robots[3].controller.edit() = "random_walk"; });
  expect_refused(other_controllers, [](auto& world, auto&, auto&) { world.fleet.robots[3].info.neighbour = "x"; });
  expect_refused(other_controllers, [](auto&, auto& options, auto&) { options.controller = "random_walk"; });
  const std::string other_options = "this process was given other options than rank 0";
  expect_refused(other_options, [](auto&, auto& options, auto&) { options.breakdown_mean_s = 60; });
  expect_refused(other_options, [](auto&, auto&, auto& distribution) { distribution.balance_steps = 3; });
}

TEST(RunIdentity, DistinguishesVersionsOfRoboSim) {
  const std::string same(24, 'x');
  requireSameRun(same + "1.2.3", same + "1.2.3");
  try {
    requireSameRun(same + "1.2.3", same + "1.2.4");
    ADD_FAILURE() << "not refused";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "this process is RoboSim 1.2.3, and rank 0 is RoboSim 1.2.4; use the same version on all machines");
  }
}

}  // namespace
}  // namespace robosim
