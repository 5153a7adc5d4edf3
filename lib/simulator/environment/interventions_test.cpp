#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "environment/environment.h"
#include "environment/placed_bodies.h"
#include "environment/step_phases.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

/// A square of 8 m with two walls, gold, and two discs of 0.25 m that can drive 0.1 m in a step.
struct Scene2 {
  explicit Scene2(const std::function<void(World&)>& change = {}) {
    World world = emptyWorld(4);
    addWall(world, 0, 2, 1, 0.2);
    addWall(world, 3, -3, 0.5, 0.5);
    addGold(world, -2, -2);
    if (change) change(world);
    Fleet fleet;
    addDisc(world, fleet, "first", {0, 0, 0});
    addDisc(world, fleet, "second", {0, -1, 0});
    environment = std::make_unique<Environment>(std::move(world), std::move(fleet), EnvironmentOptions{});
  }
  std::string apply(const Change& change) const { return environment->apply({"test", change}); }
  const State& state() const { return environment->state(); }
  void drive(int steps) const {
    for (int i = 0; i < steps; ++i) {
      environment->setCommand(0, {.speed_mps = 1});
      environment->setCommand(1, {.speed_mps = 1, .turn_radps = 0.3});
      environment->step();
    }
  }
  std::unique_ptr<Environment> environment;
};

TEST(Interventions, MakeTheRunThatAWorldWithTheObjectThereMakes) {
  const auto moved = [](World& world) { world.objects[1].body.world_from_body = {1.5, 0, 0.5}; };
  const Scene2 from_the_start(moved), placed;
  EXPECT_EQ(placed.apply(PlaceBody{"wall1", 1.5, 0, 0.5}), "");
  from_the_start.drive(40);
  placed.drive(40);
  EXPECT_GT(placed.state().stalls, 0u) << "the wall stops the first robot";
  EXPECT_EQ(placed.state().world_from_robot, from_the_start.state().world_from_robot);
  EXPECT_EQ(placed.state().readings, from_the_start.state().readings);
  EXPECT_EQ(placed.environment->objects(), from_the_start.environment->world().objects);
}

TEST(Interventions, GiveARunAnIndexOfItsOwnWhileTheOthersOfTheModelShareOne) {
  const Scene2 scene;
  const std::shared_ptr<const Model> model = scene.environment->model();
  const auto& objects = model->world.objects;
  PlacedBodies first(*model, objects), second(*model, objects);
  EXPECT_EQ(first.scene().stationary(), model->stationary);
  EXPECT_EQ(second.scene().stationary(), model->stationary);

  const std::vector<WorldObject> moved = withChange(objects, PlaceBody{"wall1", 1.5, 0, 0.5});
  second.setObjects(moved);
  EXPECT_NE(second.scene().stationary(), model->stationary);
  EXPECT_EQ(first.scene().stationary(), model->stationary);
  const Ray ahead{{0, 0, 0.5}, {1, 0, 0}};
  const auto nearest = [&](PlacedBodies& bodies) { return bodies.scene().castRay(ahead, 3).distance_m; };
  EXPECT_EQ(nearest(first), std::numeric_limits<double>::infinity());
  EXPECT_LT(nearest(second), 1.5);
  second.setObjects(objects);
  EXPECT_EQ(second.scene().stationary(), model->stationary) << "as in the beginning";
  EXPECT_EQ(nearest(second), nearest(first));
}

TEST(Interventions, OfARunDoNotAffectAnotherOfTheModel) {
  const auto moved = [](World& world) { world.objects[1].body.world_from_body = {1.5, 0, 0.5}; };
  const Scene2 undisturbed, from_the_start(moved);
  const std::shared_ptr<const Model> model = undisturbed.environment->model();
  Environment first(model, initialState(*model)), second(model, initialState(*model));
  EXPECT_EQ(second.apply({"test", PlaceBody{"wall1", 1.5, 0, 0.5}}), "");
  for (int i = 0; i < 40; ++i) {
    for (Environment* run : {&first, &second}) {
      run->setCommand(0, {.speed_mps = 1});
      run->setCommand(1, {.speed_mps = 1, .turn_radps = 0.3});
      run->step();
    }
  }
  undisturbed.drive(40);
  from_the_start.drive(40);
  EXPECT_EQ(first.state().world_from_robot, undisturbed.state().world_from_robot);
  EXPECT_EQ(second.state().world_from_robot, from_the_start.state().world_from_robot);
  EXPECT_NE(second.state().world_from_robot, first.state().world_from_robot);
  second.restart(initialState(*model));
  for (int i = 0; i < 40; ++i) {
    second.setCommand(0, {.speed_mps = 1});
    second.setCommand(1, {.speed_mps = 1, .turn_radps = 0.3});
    second.step();
  }
  EXPECT_EQ(second.state().world_from_robot, undisturbed.state().world_from_robot) << "without the change again";
}

TEST(Interventions, AreInTheDigestWithTheirStepAndWithoutTheirAuthor) {
  const auto digest = [](int step, const std::string& author, std::array<float, 3> color) {
    const Scene2 scene;
    scene.drive(step);
    EXPECT_EQ(scene.environment->apply({author, ChangeObject{.name = "wall0", .color = color}}), "");
    scene.drive(10 - step);
    return scene.environment->digest();
  };
  const Scene2 undisturbed;
  undisturbed.drive(10);
  const std::string red = digest(3, "a", {1, 0, 0});
  EXPECT_NE(red, undisturbed.environment->digest());
  EXPECT_NE(red, digest(4, "a", {1, 0, 0}));
  EXPECT_NE(red, digest(3, "a", {0, 0, 1}));
  EXPECT_EQ(red, digest(3, "b", {1, 0, 0}));
}

TEST(Interventions, AreKeptWithTheFirstStepInWhichTheyHaveAnEffectUntilTheNext) {
  const Scene2 scene;
  scene.drive(2);
  EXPECT_EQ(scene.apply(RemoveBody{"wall1"}), "");
  const AppliedIntervention expected{3, {"test", RemoveBody{"wall1"}}};
  EXPECT_EQ(scene.state().interventions, std::vector{expected});
  scene.drive(1);
  EXPECT_EQ(scene.state().interventions, std::vector{expected}) << "a recorder of the step sees it";
  scene.drive(1);
  EXPECT_TRUE(scene.state().interventions.empty());
  EXPECT_EQ(scene.state().interventions_applied, 1u);
}

TEST(Interventions, PlaceARobotAsAPersonDoesWhoLiftsIt) {
  const Scene2 scene;
  scene.drive(3);
  const auto odometry = [&] { return std::get<Odometry>(scene.state().readings[0].measurements[0]).odom_from_robot; };
  const auto before = odometry();
  EXPECT_EQ(scene.apply(PlaceBody{"first", -1, 3}), "");
  EXPECT_EQ(scene.state().world_from_robot[0], mrpt::math::TPose2D(-1, 3, 0)) << "its heading is unchanged";
  EXPECT_EQ(odometry(), before);
  EXPECT_EQ(scene.apply(PlaceBody{"first", -1, 3, 5 * M_PI / 2}), "");
  EXPECT_NEAR(scene.state().world_from_robot[0].phi, M_PI_2, 1e-12);
}

TEST(Interventions, ReachTheRefereeTheHeatAndTheRadio) {
  const Scene2 scene;
  scene.environment->checkWin(0);
  scene.environment->step();
  EXPECT_FALSE(scene.state().won) << "the gold is 2.8 m away";
  EXPECT_EQ(scene.apply(PlaceBody{"gold2", 0.9, 0}), "");  // 0.45 m from outline to outline
  scene.environment->checkWin(0);
  scene.environment->step();
  EXPECT_TRUE(scene.state().won);

  const Scene2 radio;
  Communication lost;
  lost.loss_probability = 1;
  EXPECT_EQ(radio.apply(ChangeRadio{lost}), "");
  radio.environment->send(0, "second", "hello");
  radio.environment->step();
  EXPECT_TRUE(radio.state().readings[1].inbox.empty());
  EXPECT_EQ(radio.state().messages_lost.by_chance, 1u);
}

TEST(Interventions, KeepTheOrderOfMessagesWhenTheDelayBecomesShorter) {
  const Scene2 scene;
  Communication slow, fast;
  slow.delay_s = 0.5;
  EXPECT_EQ(scene.apply(ChangeRadio{slow}), "");
  scene.environment->send(0, "second", "slow");  // sent in step 1, due in step 6
  scene.environment->step();
  EXPECT_EQ(scene.apply(ChangeRadio{fast}), "");
  scene.environment->send(0, "second", "fast");  // due in step 2
  std::string received;
  for (int i = 0; i < 6; ++i) {
    scene.environment->step();
    for (const auto& message : scene.state().readings[1].inbox) received += message.text + ' ';
  }
  EXPECT_EQ(received, "fast slow ");
}

TEST(Interventions, AreRefusedAfterTheEndOfTheRun) {
  const Scene2 scene;
  EXPECT_EQ(scene.apply(EndRun{"won"}), "");
  EXPECT_EQ(scene.apply(PlaceBody{"first", 0, 0, 0}),
            "the run has ended, with the outcome 'won', and is not changed any more");
}

TEST(Interventions, ChangeAnObjectWhoseUndersideStays) {
  const Scene2 scene;
  const Body before = scene.environment->objects()[0].body;
  EXPECT_EQ(scene.apply(ChangeObject{"wall0", 20, {{0, 1, 0}}, 3, 0.9}), "");
  const Body& after = scene.environment->objects()[0].body;
  EXPECT_EQ(after.heights(), (HeightSpan{before.heights().z_min_m, before.heights().z_min_m + 3}));
  EXPECT_EQ(after.heat_celsius, 20);
  EXPECT_EQ(after.color, (std::array{0.0f, 1.0f, 0.0f}));
  EXPECT_EQ(after.reflectivity, 0.9);
}

TEST(Interventions, MakeAHaltedRobotActiveAgainAndTheRunGoOn) {
  const Scene2 scene;
  for (const char* robot : {"first", "second"}) EXPECT_EQ(scene.apply(ChangeActivity{robot, Activity::halted}), "");
  scene.environment->step();
  EXPECT_EQ(scene.state().all_halted_step, 1u);
  EXPECT_EQ(scene.apply(ChangeActivity{"second", Activity::active}), "");
  EXPECT_FALSE(scene.state().all_halted_step);
  scene.drive(3);
  EXPECT_GT(scene.state().driven_m[1], 0.2);
  EXPECT_EQ(scene.state().driven_m[0], 0);
}

TEST(Interventions, EndTheRunOnce) {
  const Scene2 scene;
  scene.drive(4);
  EXPECT_EQ(scene.apply(EndRun{"goal", "red has scored"}), "");
  EXPECT_EQ(scene.state().ended, (RunEnd{"goal", "red has scored", 4}));
  EXPECT_EQ(scene.apply(EndRun{"again"}), "the run has ended already, with the outcome 'goal'");
}

TEST(Interventions, AreRefusedWithTheReasonAndWithoutAnEffect) {
  const Scene2 scene;
  scene.environment->remove(1);
  const State before = scene.state();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  WorldObject wall = scene.environment->objects()[0];
  const auto named = [&](const std::string& name, double x_m, double y_m) {
    wall.name = name;
    wall.body.world_from_body = {x_m, y_m, 0};
    return AddObject{wall};
  };
  const std::pair<Change, std::string> cases[] = {
      {PlaceBody{"frist", 1, 1}, "'frist' is not the name of a robot or an object; did you mean first?"},
      {PlaceBody{"first", 3.9, 0},
       "'first' would not be on the surface, which is x -4.000 to 4.000 m and y -4.000 to 4.000 m; choose another "
       "place"},
      {PlaceBody{"first", 0, 2.2}, "'first' would overlap 'wall0'; choose another place"},
      {PlaceBody{"wall1", 0.3, 0}, "'wall1' would overlap 'first'; choose another place"},
      {PlaceBody{"wall1", 0, 2}, "'wall1' would overlap 'wall0'; choose another place"},
      {PlaceBody{"wall1", 5, 0},
       "'wall1' would not be on the surface, which is x -4.000 to 4.000 m and y -4.000 to 4.000 m; choose another "
       "place"},
      {PlaceBody{"first", nan, 0}, "<place x=\"nan\">: must be a finite number; write a number there"},
      {named("first", 2, 2), "there is a robot or an object named 'first' already; use another name"},
      {named("new", 0, 0), "'new' would overlap 'first'; choose another place"},
      {RemoveBody{"second"}, "robot 'second' is not in the world at present; place it first"},
      {ChangeActivity{"second", Activity::active}, "robot 'second' is not in the world at present; place it first"},
      {ChangeActivity{"first", Activity::absent},
       "<activity value=\"absent\">: is unknown; accepted are: active, halted, found"},
      {ChangeActivity{"wall0"}, "'wall0' is an object; name a robot"},
      {ChangeObject{"first", 1}, "'first' is a robot, whose body stays as its type describes it; name an object"},
      {ChangeObject{"wall0"}, "<change>: changes nothing; give hot, color, height, reflectivity, light or fiducial"},
      {ChangeObject{.name = "wall0", .height_m = 0}, "<change height=\"0\">: must be above 0; write a number there"},
      {EndRun{""}, "<end outcome=\"\">: is empty; write a word there"},
  };
  for (const auto& [change, fault] : cases) EXPECT_EQ(scene.apply(change), fault);
  EXPECT_EQ(scene.state(), before);
}

TEST(Interventions, AreAtMostAThousandBetweenTwoSteps) {
  const Scene2 scene;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(scene.apply(ChangeActivity{"first", i % 2 == 0 ? Activity::halted : Activity::active}), "");
  }
  EXPECT_EQ(scene.apply(ChangeActivity{"first", Activity::halted}),
            "there are 1,000 interventions of test before this step, which is the most; wait for the next step");
  EXPECT_EQ(scene.environment->apply({"another", ChangeActivity{"first", Activity::halted}}), "");
  scene.environment->step();
  EXPECT_EQ(scene.apply(ChangeActivity{"first", Activity::halted}), "");
}

TEST(Interventions, OfAWorldFileAreAppliedBeforeTheFirstStepThatBeginsThen) {
  const auto timeline = [](World& world) {
    world.timeline = {{0.3, PlaceBody{"wall1", 1, 0}, {}}, {0.35, RemoveBody{"wall1"}, {}}};
  };
  const Scene2 scene(timeline);
  const auto wall_x_m = [&] {
    return scene.environment->objects().size() == 3 ? scene.environment->objects()[1].body.world_from_body.x : -1;
  };
  std::vector<double> x_m;
  for (int i = 0; i < 6; ++i) {
    scene.environment->step();
    x_m.push_back(wall_x_m());
  }
  // Steps 1 to 3 begin at 0, 0.1 and 0.2 s; step 4 at 0.3 s; step 5, the first after 0.35 s, at 0.4 s.
  EXPECT_EQ(x_m, (std::vector<double>{3, 3, 3, 1, -1, -1}));
  EXPECT_EQ(scene.state().interventions_applied, 2u);
}

TEST(Interventions, OfAWorldFileThatAreImpossibleHaveNoEffect) {
  const Scene2 scene([](World& world) { world.timeline = {{0, PlaceBody{"wall1", 0, 0}, {}}}; });
  const Scene2 undisturbed;
  testing::internal::CaptureStderr();
  scene.drive(1);
  undisturbed.drive(1);
  EXPECT_EQ(
      testing::internal::GetCapturedStderr(),
      "robosim: the change in line 0 of the world file, at 0.000 s, has no effect: 'wall1' would overlap 'first'; "
      "choose another place\n");
  EXPECT_EQ(scene.environment->digest(), undisturbed.environment->digest());
}

TEST(Interventions, OfAReplicaFollowThoseOfItsOriginalWithoutBeingChecked) {
  const Scene2 original, replica;
  replica.environment->phases().limitTo(std::vector<std::uint32_t>{1}, {1, 2});
  const Intervention moved{"test", PlaceBody{"wall1", 1.5, 1.5}};
  EXPECT_EQ(original.environment->apply(moved), "");
  replica.environment->applyAgain(moved);
  EXPECT_EQ(replica.environment->objects(), original.environment->objects());
  EXPECT_EQ(replica.environment->state().interventions, original.environment->state().interventions);
}

}  // namespace
}  // namespace robosim
