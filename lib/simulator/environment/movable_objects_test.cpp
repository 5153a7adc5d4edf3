#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "base/random.h"
#include "environment/environment.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

/// A square of 8 m with a box of 0.4 m ahead of a disc of 0.25 m.
std::unique_ptr<Environment> boxAheadOfRobot(const std::function<void(World&)>& change = {}) {
  World world = emptyWorld(4);
  addWall(world, 0, 3, 1, 0.2);
  addBox(world, {1, 0, 0}, 0.4, 0.4, {.mass_kg = 2});
  if (change) change(world);
  Fleet fleet;
  addDisc(world, fleet, "robot", {0, 0, 0});
  return std::make_unique<Environment>(std::move(world), std::move(fleet), EnvironmentOptions{});
}

void drive(Environment& environment, int steps, double turn_radps = 0) {
  for (int i = 0; i < steps; ++i) {
    environment.setCommand(0, {.speed_mps = 0.5, .turn_radps = turn_radps});
    environment.step();
  }
}

const mrpt::math::TPose2D& placeOf(const Environment& environment, std::size_t object) {
  return environment.objects()[object].body.world_from_body;
}

TEST(MovableObjects, ArePushedByARobotThatIsNotStalled) {
  const auto environment = boxAheadOfRobot();
  drive(*environment, 40);
  EXPECT_NEAR(environment->state().world_from_robot[0].x, 2, 1e-12);
  EXPECT_NEAR(placeOf(*environment, 1).x, 2 + 0.25 + 0.2, 1e-5);
  EXPECT_EQ(environment->state().stalls, 0u);
  EXPECT_EQ(placeOf(*environment, 0), environment->world().objects[0].body.world_from_body) << "the wall";
  drive(*environment, 40);
  EXPECT_TRUE(environment->state().stalled[0]) << "the box is at the edge of the surface";
  EXPECT_NEAR(placeOf(*environment, 1).x, 3.8, 1e-4);
}

TEST(MovableObjects, AreSensedWhereTheyAre) {
  // A world with the box where it was pushed to makes the same places free and occupied.
  const auto pushed = boxAheadOfRobot();
  drive(*pushed, 40);
  const auto& at = placeOf(*pushed, 1);
  EXPECT_NE(pushed->apply({"test", PlaceBody{"robot", at.x, at.y}}).find("overlap 'box1'"), std::string::npos);
  EXPECT_EQ(pushed->apply({"test", PlaceBody{"robot", 1, 0}}), "") << "where the box was";
}

TEST(MovableObjects, AreInTheDigest) {
  const auto digest = [](double mass_kg) {
    const auto environment = boxAheadOfRobot([&](World& world) {
      world.objects[1].movable = Movable{mass_kg, 0.1, 0.5};
    });
    drive(*environment, 30, 0.1);
    return environment->digest();
  };
  EXPECT_EQ(digest(2), digest(2));
  EXPECT_NE(digest(2), digest(2000)) << "the robot is blocked";
}

TEST(MovableObjects, ContinueFromASavedState) {
  const auto first = boxAheadOfRobot([](World& world) { world.objects[1].movable = Movable{1, 0.01, 1}; });
  drive(*first, 14);
  const State saved = first->state();
  EXPECT_FALSE(saved.object_speeds[0].isAtRest());
  drive(*first, 20, 0.2);
  const auto second = boxAheadOfRobot([](World& world) { world.objects[1].movable = Movable{1, 0.01, 1}; });
  drive(*second, 3, -0.5);
  second->restore(saved);
  drive(*second, 20, 0.2);
  EXPECT_EQ(second->state(), first->state());
}

TEST(MovableObjects, KeepTheirSpeedWhenAnotherIsMovedAndLoseTheirOwnWhenTheyAre) {
  const auto environment = boxAheadOfRobot([](World& world) {
    world.objects[1].movable = Movable{1, 0.01, 1};
    addBox(world, {-2, -2, 0}, 0.4, 0.4);
  });
  drive(*environment, 14);
  const ObjectSpeed speed = environment->state().object_speeds[0];
  EXPECT_GT(speed.vx_mps, 0);
  EXPECT_EQ(environment->apply({"test", RemoveBody{"box2"}}), "");
  EXPECT_EQ(environment->state().object_speeds, std::vector{speed});
  EXPECT_EQ(environment->apply({"test", PlaceBody{"box1", -2, -2}}), "");
  EXPECT_TRUE(environment->state().object_speeds[0].isAtRest());
}

TEST(MovableObjects, MayNotBePlacedAcrossTheEdgeOfTheSurface) {
  const auto environment = boxAheadOfRobot();
  EXPECT_EQ(environment->apply({"test", PlaceBody{"wall0", 3.9, 0}}), "") << "a stationary one may reach over it";
  EXPECT_NE(environment->apply({"test", PlaceBody{"box1", -3.9, 0}}).find("would not be on the surface"),
            std::string::npos);
}

TEST(Doors, AreOpenedByInterventionsAndTheWorldFile) {
  const auto environment = boxAheadOfRobot([](World& world) {
    WorldObject door = world.objects[0];
    door.name = "door";
    door.body.world_from_body = {1, 0, M_PI_2};
    door.door = Door{.world_from_closed = door.body.world_from_body, .slide_m = 1.5, .speed = 1};
    world.objects[1] = door;
    world.timeline = {{4, OpenDoor{"door"}, {}}, {8, OpenDoor{"door", 0}, {}}};
  });
  drive(*environment, 40);
  EXPECT_TRUE(environment->state().stalled[0]) << "the door is closed";
  drive(*environment, 20);
  EXPECT_GT(environment->state().world_from_robot[0].x, 1) << "through the open door";
  EXPECT_EQ(environment->objects()[1].door->share, 1);
  drive(*environment, 40);
  EXPECT_EQ(environment->objects()[1].body.world_from_body, environment->objects()[1].door->world_from_closed);
  EXPECT_EQ(environment->apply({"test", OpenDoor{"door", 0.5}}), "");
  EXPECT_EQ(environment->apply({"test", OpenDoor{"wall0"}}), "'wall0' is no door; name one");
  EXPECT_NE(environment->apply({"test", PlaceBody{"door", 0, 0}}).find("is a door"), std::string::npos);
}

/// The world of boxAheadOfRobot() with a person in place of the box.
std::unique_ptr<Environment> personAheadOfRobot(const Walker& walker) {
  return boxAheadOfRobot([&](World& world) {
    WorldObject& object = world.objects[1];
    object.name = "person";
    object.movable.reset();
    object.body.shape = Cylinder{0.25};
    object.walker = walker;
    object.walker->home = {object.body.world_from_body.x, object.body.world_from_body.y};
  });
}

TEST(Walkers, StandInTheWayOfRobots) {
  const auto environment = personAheadOfRobot({.route = {{1, 0.001}}});
  drive(*environment, 40);
  EXPECT_TRUE(environment->state().stalled[0]);
  EXPECT_NEAR(environment->state().world_from_robot[0].x, 0.5, 1e-2);
}

TEST(Walkers, ContinueFromASavedState) {
  const Walker walker{.wanders_within_m = 2, .speed_mps = 1.7};
  const auto first = personAheadOfRobot(walker);
  drive(*first, 37, 1);
  const State saved = first->state();
  EXPECT_GT(first->objects()[1].walker->walk.leg, 0u);
  drive(*first, 30, 1);
  const auto second = personAheadOfRobot(walker);
  drive(*second, 5, -1);
  second->restore(saved);
  drive(*second, 30, 1);
  EXPECT_EQ(second->state(), first->state());
  EXPECT_EQ(second->digest(), first->digest());
}

TEST(Walkers, AreAddedAndPlacedByInterventions) {
  const auto environment = personAheadOfRobot({.route = {{1, 2}}, .speed_mps = 1});
  EXPECT_EQ(environment->apply({"test", PlaceBody{"person", 2, 0}}), "");
  environment->step();
  EXPECT_LT(placeOf(*environment, 1).x, 2) << "it walks on to the place of its route";
  EXPECT_NE(environment->apply({"test", PlaceBody{"person", 0, 0}}).find("overlap 'robot'"), std::string::npos);
  WorldObject other = environment->world().objects[1];
  other.name = "other";
  other.body.world_from_body = {-2, -2, 0};
  other.walker = Walker{.home = {-2, -2}, .route = {{2, -2}}, .speed_mps = 1};
  EXPECT_EQ(environment->apply({"test", AddObject{other}}), "");
  for (int i = 0; i < 10; ++i) environment->step();
  EXPECT_NEAR(placeOf(*environment, 2).x, -1, 1e-9);
}

TEST(Conveyors, CarryBoxesButNoRobots) {
  const auto environment = boxAheadOfRobot([](World& world) {
    WorldObject belt = world.objects[0];
    belt.name = "belt";
    belt.body.shape = Cube{6, 1};
    belt.body.world_from_body = {0, 0, 0};
    belt.body.center_z_m = -0.05;
    belt.body.height_m = 0.1;
    belt.conveyor = Conveyor{0.4};
    world.objects.push_back(belt);
  });
  for (int i = 0; i < 20; ++i) environment->step();
  EXPECT_EQ(environment->state().world_from_robot[0].x, 0);
  EXPECT_NEAR(placeOf(*environment, 1).x, 1 + 2 * 0.4 - 0.4 * 0.4 / (2 * 0.5 * 9.81), 5e-3);
}

TEST(Doors, ThatARobotHoldsContinueFromASavedState) {
  const auto held_door = [] {
    return boxAheadOfRobot([](World& world) {
      WorldObject door = world.objects[0];
      door.name = "door";
      door.body.world_from_body = {0, 0.5, M_PI_2};
      door.door = Door{.world_from_closed = {0, -0.2, M_PI_2}, .slide_m = 1.2, .share = 1};
      door.body.world_from_body = door.door->poseAt(1, 1);
      world.objects[1] = door;
    });
  };
  const auto first = held_door();
  for (int i = 0; i < 30; ++i) first->step();
  const double share = first->objects()[1].door->share;
  EXPECT_GT(share, 0.2) << "the robot is in its way";
  EXPECT_LT(share, 1);
  const State saved = first->state();
  for (int i = 0; i < 5; ++i) first->step();
  const auto second = held_door();
  second->restore(saved);
  for (int i = 0; i < 5; ++i) second->step();
  EXPECT_EQ(second->state(), first->state());
  EXPECT_EQ(second->digest(), first->digest());
}

TEST(Doors, AreAddedInWallsButNotInRobots) {
  const auto environment = boxAheadOfRobot();
  WorldObject door = environment->world().objects[0];
  door.name = "door";
  door.door = Door{.world_from_closed = door.body.world_from_body, .slide_m = 1};
  EXPECT_EQ(environment->apply({"test", AddObject{door}}), "");
  door.name = "another";
  door.body.world_from_body = door.door->world_from_closed = {0, 0.2, 0};
  EXPECT_NE(environment->apply({"test", AddObject{door}}).find("overlap 'robot'"), std::string::npos);
}

/// Robots that drive about among boxes, balls and people, in rows.
std::unique_ptr<Environment> crowd(std::uint64_t seed, int threads) {
  Rng rng(seed);
  World world = emptyWorld(4);
  Fleet fleet;
  int robots = 0;
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 7; ++column) {
      const double x_m = column - 3 + rng.uniform(-0.2, 0.2), y_m = row - 3 + rng.uniform(-0.2, 0.2);
      const double heading_rad = rng.uniform(-3, 3);
      const auto kind = rng.below(5);
      if (kind == 0) continue;
      if (kind == 1) {
        addDisc(world, fleet, "r" + std::to_string(robots++), {x_m, y_m, heading_rad}, 0.2);
      } else if (column == 3 && row % 3 == 0) {
        addWall(world, x_m, y_m, 0.6, 0.1, heading_rad);
        WorldObject& object = world.objects.back();
        object.door = Door{.world_from_closed = object.body.world_from_body, .speed = 0.7, .opens_within_m = 0.5};
        (row == 3 ? object.door->slide_m : object.door->turn_rad) = 0.8;
      } else if (kind == 4 && row == 1) {
        addBox(world, {x_m, y_m, 0}, 0.1, 0.1);
        WorldObject& object = world.objects.back();
        object.movable.reset();
        object.body.shape = Cylinder{0.25};
        object.walker = Walker{.home = {x_m, y_m}, .wanders_within_m = 3, .speed_mps = rng.uniform(0.5, 2)};
      } else if (kind == 2) {
        addBox(world, {x_m, y_m, heading_rad}, rng.uniform(0.1, 0.5), rng.uniform(0.1, 0.25),
               {.mass_kg = rng.uniform(0.5, 5), .friction = rng.uniform(0.1, 0.7)});
      } else {
        addBox(world, {x_m, y_m, 0}, 0.1, 0.1, {.mass_kg = 0.4, .friction = 0.02, .restitution = 0.8});
        world.objects.back().body.shape = Cylinder{rng.uniform(0.05, 0.2)};
      }
    }
  }
  EnvironmentOptions options;
  options.threads = threads;
  return std::make_unique<Environment>(std::move(world), std::move(fleet), options);
}

void wander(Environment& environment, std::uint64_t seed) {
  for (std::uint32_t r = 0; r < environment.robotCount(); ++r) {
    Rng rng(seed, RandomPurpose::test, r, 0, environment.time().step / 10);
    environment.setCommand(r, {.speed_mps = rng.uniform(-0.5, 1), .turn_radps = rng.uniform(-1, 1)});
  }
  environment.step();
}

/// The largest overlap of two bodies by which their distance is below the sum of their extents [m].
double deepestOverlap(const Environment& environment) {
  std::vector<Solid> solids;
  for (const auto& object : environment.objects()) solids.push_back(object.body.solid());
  for (std::size_t r = 0; r < environment.robotCount(); ++r) {
    const auto& pose = environment.state().world_from_robot[r];
    solids.push_back({Circle{{pose.x, pose.y}, environment.fleet().robots[r].info.radius_m}, {0, 0.3}});
  }
  double deepest_m = 0;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!overlap(solids[i], solids[j])) continue;
      // Shrunk by a nanometre, they must not.
      const auto shrunk = [](Solid solid) {
        if (auto* circle = std::get_if<Circle>(&solid.outline)) circle->radius_m -= 1e-9;
        if (auto* box = std::get_if<OrientedBox>(&solid.outline)) box->half_length_m -= 1e-9, box->half_width_m -= 1e-9;
        return solid;
      };
      deepest_m = overlap(shrunk(solids[i]), shrunk(solids[j])) ? 1 : std::max(deepest_m, 1e-9);
    }
  }
  return deepest_m;
}

TEST(MovableObjects, NeverOverlapAmongManyRobots) {
  double moved_m = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const auto environment = crowd(seed, 1);
    for (int step = 0; step < 100; ++step) {
      wander(*environment, seed);
      ASSERT_LE(deepestOverlap(*environment), 1e-9) << seed << " in step " << step;
    }
    for (std::size_t i = 0; i < environment->objects().size(); ++i) {
      const auto& start = environment->world().objects[i].body.world_from_body;
      moved_m += std::hypot(placeOf(*environment, i).x - start.x, placeOf(*environment, i).y - start.y);
    }
  }
  EXPECT_GT(moved_m, 50) << "of all objects together";
}

TEST(MovableObjects, MakeTheSameRunForAnyNumberOfThreads) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    std::string of_one;
    for (const int threads : {1, 2, 3, 8}) {
      const auto environment = crowd(seed, threads);
      for (int step = 0; step < 60; ++step) wander(*environment, seed);
      if (threads == 1) of_one = environment->digest();
      EXPECT_EQ(environment->digest(), of_one) << seed << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace robosim
