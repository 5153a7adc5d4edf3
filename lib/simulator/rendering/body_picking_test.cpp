#include "rendering/body_picking.h"

#include <cmath>

#include <gtest/gtest.h>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose3D;

/// A table of 2 m × 1 m at the origin, whose top lies between 0.7 and 0.8 m, a post of 0.5 m radius and 1 m height 4 m
/// behind it, and a robot of 0.2 m radius and height below the table.
struct RoomWithTable {
  LoadedWorld world;
  RunSnapshot snapshot;

  RoomWithTable() {
    world.world.objects.resize(2);
    world.world.objects[0].name = "table";
    world.world.objects[0].body = {Cube{2, 1}, {0, 0, 0}, 0.75, 0.1};
    world.world.objects[1].name = "post";
    world.world.objects[1].body = {Cylinder{0.5}, {4, 0, 0}, 0.5, 1};
    FleetRobot robot;
    robot.info.name = "Ann";
    robot.info.radius_m = 0.2;
    robot.own_body = Body{.shape = {}, .world_from_body = {}, .center_z_m = 0.1, .height_m = 0.2};
    world.fleet.robots.push_back(robot);
    snapshot.robots.emplace_back().world_from_robot = {0, 0, 1};
  }
  /// The name of what is at a pixel; "-" for nothing.
  std::string at(const PaneProjection& pane, const TPoint2D& pixel) const {
    const auto body = pickBody(pane, pixel, snapshot, world);
    return body ? body->name : "-";
  }
};

/// From above: 101 × 101 pixels of 0.1 m about (1, 0), shown twice as large from (20, 10) on. A point (x, y) is at
/// (20 + 2 (50 + 10 (x - 1)), 10 + 2 (50 - 10 y)) = (100 + 20 x, 110 - 20 y).
const PaneProjection kAbove(GroundView(101, 101, {1, 0}, 10), {20, 10}, 2);
TPoint2D above(double x, double y) { return {100 + 20 * x, 110 - 20 * y}; }

/// A camera of 101 × 101 pixels, whose focal length is 50.5 pixels.
PaneProjection camera(const TPose3D& world_from_camera) {
  CameraInfo info;
  info.width_px = info.height_px = 101;
  info.field_of_view_rad = M_PI / 2;
  return {info, world_from_camera, {0, 0}};
}

TEST(BodyPicking, FromAbovePrefersRobotsWhichAreDrawnOverObjects) {
  const RoomWithTable scene;
  EXPECT_EQ(scene.at(kAbove, above(0, 0)), "Ann") << "below the table";
  EXPECT_EQ(scene.at(kAbove, above(0.95, 0.45)), "table");
  EXPECT_EQ(scene.at(kAbove, above(1.05, 0.45)), "-");
  EXPECT_EQ(scene.at(kAbove, above(4.34, 0.34)), "post") << "0.48 m from its centre";
  EXPECT_EQ(scene.at(kAbove, above(4.37, 0.37)), "-") << "0.52 m from it";
}

TEST(BodyPicking, FromAboveTakesSmallRobotsToBeSixPixelsInRadius) {
  const RoomWithTable scene;
  // A pixel of the picture is 0.05 m: 6 pixels are 0.3 m.
  EXPECT_EQ(scene.at(kAbove, above(0.29, 0)), "Ann");
  EXPECT_EQ(scene.at(kAbove, above(0.31, 0)), "table");
}

TEST(BodyPicking, DoesNotFindAbsentRobotsAndRemovedObjects) {
  RoomWithTable scene;
  scene.snapshot.robots[0].activity = Activity::absent;
  EXPECT_EQ(scene.at(kAbove, above(0, 0)), "table");
  EXPECT_FALSE(bodyNamed("Ann", scene.snapshot, scene.world));
  scene.snapshot.objects = ChangedObjects(withChange(scene.world.world.objects, RemoveBody{"table"}));
  EXPECT_EQ(scene.at(kAbove, above(0, 0)), "-");
  EXPECT_FALSE(bodyNamed("table", scene.snapshot, scene.world));
  EXPECT_TRUE(bodyNamed("post", scene.snapshot, scene.world));
}

TEST(BodyPicking, FindsBodiesAtTheirPresentPlaces) {
  RoomWithTable scene;
  scene.snapshot.robots[0].world_from_robot = {2, 1, 0};
  scene.snapshot.objects = ChangedObjects(withChange(scene.world.world.objects, PlaceBody{"post", 0, 2, 1.5}));
  EXPECT_EQ(scene.at(kAbove, above(2, 1)), "Ann");
  EXPECT_EQ(scene.at(kAbove, above(0, 2)), "post");
  EXPECT_EQ(bodyNamed("post", scene.snapshot, scene.world)->body.world_from_body, mrpt::math::TPose2D(0, 2, 1.5));
}

TEST(BodyPicking, OfACameraFindsTheNearestBodyInTheLineOfSight) {
  const RoomWithTable scene;
  // Level, along x, from 10 m before the table. A pixel at a distance of 10 m is 10 / 50.5 m = 0.198 m.
  const PaneProjection at_table = camera({-11, 0, 0.75, 0, 0, 0}), below = camera({-11, 0, 0.1, 0, 0, 0}),
                       between = camera({-11, 0, 0.5, 0, 0, 0}), over_all = camera({-11, 0, 1.1, 0, 0, 0});
  EXPECT_EQ(scene.at(at_table, {50, 50}), "table");
  EXPECT_EQ(scene.at(below, {50, 50}), "Ann");
  EXPECT_EQ(scene.at(between, {50, 50}), "post") << "between the robot and the table's top";
  EXPECT_EQ(scene.at(over_all, {50, 50}), "-");
  EXPECT_NEAR(pickBody(at_table, {50, 50}, scene.snapshot, scene.world)->at_z_m, 0.75, 1e-12);
}

TEST(PaneProjection, FromAboveConvertsPixelsOfThePicture) {
  const auto pixel = kAbove.pixelOf({2, 1, 0.3});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 140, 1e-9);
  EXPECT_NEAR(pixel->y, 90, 1e-9);
  const auto at = kAbove.onLevel(0.3, *pixel);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->x, 2, 1e-9);
  EXPECT_NEAR(at->y, 1, 1e-9);
}

TEST(PaneProjection, OfACameraFindsThePointOfALevel) {
  // 10 m above the origin, looking down, with +x upwards in the picture: 5.05 pixels are 1 m on the ground, to the
  // right -y.
  const PaneProjection down = camera({0, 0, 10, 0, M_PI / 2, 0});
  const auto ground = down.onLevel(0, {55.05, 39.9});
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->x, 2, 1e-9);
  EXPECT_NEAR(ground->y, -1, 1e-9);
  const auto pixel = down.pixelOf({2, -1, 0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 55.05, 1e-9);
  EXPECT_NEAR(pixel->y, 39.9, 1e-9);
  const PaneProjection level = camera({0, 0, 10, 0, 0, 0});
  EXPECT_FALSE(level.onLevel(0, {50, 40})) << "above the horizon";
  EXPECT_FALSE(level.onLevel(0, {50, 50})) << "on it";
  EXPECT_FALSE(level.pixelOf({-1, 0, 0})) << "behind the camera";
}

}  // namespace
}  // namespace robosim
