#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "environment/environment.h"
#include "environment/state_bytes.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

/// A square of 8 m with a wall and two discs of 0.25 m that can drive 0.1 m in a step. Their type is known.
struct AddingWorld {
  World world;
  Fleet fleet;

  explicit AddingWorld(int robots = 2, double half_m = 4) : world(emptyWorld(half_m)) {
    addWall(world, 0, 2, 1, 0.2);
    for (int i = 0; i < robots; ++i)
      addDisc(world, fleet, "disc" + std::to_string(i), {-3 + 0.6 * (i % 10), -3 - 0.6 * (i / 10), 0});
    auto known = std::make_shared<KnownTypes>();
    known->models["disc"] = fleet.robots[0].model;
    fleet.known_types = known;
  }
};

std::unique_ptr<Environment> addingRun(const AddingWorld& small = AddingWorld(), int threads = 1) {
  EnvironmentOptions options;
  options.threads = threads;
  return std::make_unique<Environment>(small.world, small.fleet, options);
}

AddRobot newRobot(const std::string& name, double x_m, double y_m, double heading_rad = 0) {
  return {name, "disc", {x_m, y_m, heading_rad}};
}

std::string applied(Environment& environment, const Change& change) { return environment.apply({"test", change}); }

void driveAll(Environment& environment, int steps) {
  for (int k = 0; k < steps; ++k) {
    for (std::size_t i = 0; i < environment.robotCount(); ++i) {
      environment.setCommand(i, {.speed_mps = 1, .turn_radps = 0.1 * static_cast<double>(i % 3)});
      environment.broadcast(i, "here");
    }
    environment.step();
  }
}

TEST(AddedRobots, AreTheLastAndMoveFromTheNextStep) {
  const auto environment = addingRun();
  driveAll(*environment, 3);
  ASSERT_EQ(applied(*environment, newRobot("new", 1, -1, M_PI_2)), "");
  EXPECT_EQ(environment->robotNames(), (std::vector<std::string>{"disc0", "disc1", "new"}));
  EXPECT_EQ(environment->robotCount(), 3u);
  EXPECT_EQ(environment->state().world_from_robot[2], mrpt::math::TPose2D(1, -1, M_PI_2));
  environment->setCommand(2, {.speed_mps = 1});
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[2].y, -0.9, 1e-12) << "1 m/s for 0.1 s";
  EXPECT_NEAR(std::get<Odometry>(environment->state().readings[2].measurements[0]).odom_from_robot.x, 0.1, 1e-12);
}

TEST(AddedRobots, DriveAsIfTheWorldHadHadThemWithoutMoving) {
  AddingWorld with_third;
  addDisc(with_third.world, with_third.fleet, "new", {1, -1, 0});
  const auto from_the_start = addingRun(with_third), later = addingRun();
  for (int k = 0; k < 5; ++k) {
    for (auto* environment : {from_the_start.get(), later.get()}) {
      for (std::size_t i = 0; i < 2; ++i) environment->setCommand(i, {.speed_mps = 0.5});
      environment->step();
    }
  }
  ASSERT_EQ(applied(*later, newRobot("new", 1, -1)), "");
  driveAll(*from_the_start, 60);
  driveAll(*later, 60);
  EXPECT_GT(later->state().stalls, 0u);
  EXPECT_EQ(later->state().world_from_robot, from_the_start->state().world_from_robot);
  EXPECT_EQ(later->state().readings, from_the_start->state().readings);
}

TEST(AddedRobots, BlockOthersAndReceiveTheirMessages) {
  const auto environment = addingRun();
  ASSERT_EQ(applied(*environment, newRobot("new", -1.8, -3)), "") << "0.1 m in front of disc1";
  environment->setCommand(1, {.speed_mps = 1});
  environment->send(0, "new", "hello");
  environment->step();
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[1].x, -2.3, 1e-3);
  EXPECT_EQ(environment->state().stalled[1], 1);
  environment->send(2, "disc0", "answer");
  environment->step();
  ASSERT_EQ(environment->state().readings[0].inbox.size(), 1u);
  EXPECT_EQ(environment->state().readings[0].inbox[0].from, "new");
}

TEST(AddedRobots, AreRefusedWithTheReasonAndWithoutAnEffect) {
  const auto environment = addingRun();
  const State before = environment->state();
  AddRobot unknown_type = newRobot("new", 1, 1), with_neighbour = newRobot("new", 1, 1);
  unknown_type.model = "dics";
  with_neighbour.neighbour = "disc7";
  const std::pair<Change, std::string> cases[] = {
      {newRobot("disc0", 1, 1), "there is a robot or an object named 'disc0' already; use another name"},
      {newRobot("wall0", 1, 1), "there is a robot or an object named 'wall0' already; use another name"},
      {newRobot("new", 0, 2.2), "'new' would overlap 'wall0'; choose another place"},
      {newRobot("new", -3, -2.8), "'new' would overlap 'disc0'; choose another place"},
      {newRobot("new", 3.9, 0),
       "'new' would not be on the surface, which is x -4.000 to 4.000 m and y -4.000 to 4.000 m; choose another place"},
      {with_neighbour, "'disc7' is not the name of a robot; did you mean disc0?"},
  };
  for (const auto& [change, fault] : cases) EXPECT_EQ(applied(*environment, change), fault);
  EXPECT_NE(applied(*environment, unknown_type).find("there is no robot type 'dics'"), std::string::npos);
  EXPECT_NE(applied(*environment, AddRobot{"", "disc", {}}), "");
  environment->setRobotCheck([](const FleetRobot& robot) { return robot.info.name + " is not wanted"; });
  EXPECT_EQ(applied(*environment, newRobot("new", 1, 1)), "new is not wanted");
  EXPECT_EQ(environment->state(), before);
  EXPECT_EQ(environment->robotCount(), 2u);
}

TEST(AddedRobots, LeaveModelsValidForTheirReaders) {
  const auto environment = addingRun();
  const Model& before = *environment->model();
  const World& world = environment->world();
  ASSERT_EQ(applied(*environment, newRobot("new", 1, 1)), "");
  EXPECT_EQ(before.fleet.robots.size(), 2u);
  EXPECT_EQ(environment->model()->fleet.robots.size(), 3u);
  EXPECT_EQ(&environment->world(), &world);
  EXPECT_EQ(environment->presentWorld().robots.back().name, "new");
}

TEST(AddedRobots, GiveTheSameDigestForAnyNumberOfThreads) {
  const auto digest = [](int threads, bool adds) {
    const auto environment = addingRun(AddingWorld(240, 20), threads);
    std::size_t count = 240;
    for (int i = 0; i < 200; ++i) {  // of which the last are in another chunk of the digest than the first
      const AddRobot robot = newRobot("new" + std::to_string(i), 12 + 0.05 * i, 0.6 * (i % 20));
      if (adds) count += applied(*environment, robot).empty() ? 1 : 0;  // or it would overlap another
      driveAll(*environment, i % 20 == 0 ? 1 : 0);
    }
    EXPECT_EQ(environment->robotCount(), count);
    return std::pair(environment->digest(), count);
  };
  const auto one = digest(1, true);
  EXPECT_GT(one.second, 256u);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(digest(threads, true), one) << threads;
  EXPECT_NE(digest(1, false).first, one.first);
}

TEST(AddedRobots, AreInSavedStatesThatContinueEqually) {
  const auto original = addingRun();
  driveAll(*original, 2);
  ASSERT_EQ(applied(*original, newRobot("new", 1, -1)), "");
  driveAll(*original, 2);
  ASSERT_EQ(applied(*original, newRobot("newer", 1, 1, 2)), "");
  const std::shared_ptr<const Model> start = addingRun()->model();
  const std::string bytes = toBytes(*original->model(), original->state());
  for (const auto& model : {start, original->model()}) {
    const State state = stateFromBytes(*model, bytes);
    EXPECT_EQ(state, original->state());
    Environment forked(model, state, 2);
    EXPECT_EQ(forked.robotNames(), original->robotNames());
    Environment restored(start, initialState(*start));
    restored.restore(state);
    const auto saved = original->state();
    for (auto* environment : {original.get(), &forked, &restored}) driveAll(*environment, 20);
    EXPECT_EQ(forked.state(), original->state());
    EXPECT_EQ(restored.state(), original->state());
    EXPECT_EQ(restored.digest(), original->digest());
    original->restore(saved);
  }
}

TEST(AddedRobots, AreGoneInAStateFromBefore) {
  const auto environment = addingRun();
  driveAll(*environment, 3);
  const State before = environment->state();
  const auto undisturbed = addingRun();
  undisturbed->restore(before);
  ASSERT_EQ(applied(*environment, newRobot("new", 1, -1)), "");
  driveAll(*environment, 5);
  environment->restore(before);
  EXPECT_EQ(environment->robotCount(), 2u);
  driveAll(*environment, 5);
  driveAll(*undisturbed, 5);
  EXPECT_EQ(environment->state(), undisturbed->state());
  environment->restart(initialState(*addingRun()->model()));
  EXPECT_EQ(environment->digest(), addingRun()->digest());
}

TEST(AddedRobots, OfAnotherTypeThanTheSavedOnesAreRefused) {
  const auto original = addingRun();
  ASSERT_EQ(applied(*original, newRobot("new", 1, -1)), "");
  const std::string bytes = toBytes(*original->model(), original->state());
  AddingWorld changed;
  auto types = std::make_shared<KnownTypes>(*changed.fleet.known_types);
  auto faster = std::make_shared<RobotModel>(*types->models["disc"]);
  faster->limits.speed_max_mps = faster->type_info.edit().limits.speed_max_mps = 2;
  types->models["disc"] = faster;
  changed.fleet.known_types = types;
  try {
    stateFromBytes(*addingRun(changed)->model(), bytes);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "the robot type disc is not that of the run that saved the state; use its robot types");
  }
}

TEST(AddedRobots, OfAWorldFileComeInTheFirstStepThatBeginsThen) {
  AddingWorld small;
  small.world.timeline = {{0.3, newRobot("new", 1, 1), {}}, {0.3, PlaceBody{"new", 2, 2}, {}}};
  const auto environment = addingRun(small);
  std::vector<std::size_t> robots;
  for (int i = 0; i < 5; ++i) {
    environment->step();
    robots.push_back(environment->robotCount());
  }
  EXPECT_EQ(robots, (std::vector<std::size_t>{2, 2, 2, 3, 3})) << "step 4 begins at 0.3 s";
  EXPECT_EQ(environment->state().world_from_robot[2], mrpt::math::TPose2D(2, 2, 0));
}

TEST(AddedRobots, LetARunGoOnInWhichAllHadHalted) {
  const auto environment = addingRun();
  for (const char* robot : {"disc0", "disc1"})
    ASSERT_EQ(applied(*environment, ChangeActivity{robot, Activity::halted}), "");
  environment->step();
  ASSERT_TRUE(environment->state().all_halted_step);
  ASSERT_EQ(applied(*environment, newRobot("new", 1, 1)), "");
  EXPECT_FALSE(environment->state().all_halted_step);
}

}  // namespace
}  // namespace robosim
