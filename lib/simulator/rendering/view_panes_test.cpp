// Panes of a view, and the camera of 3D panes.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "rendering/panes.h"
#include "rendering/testing/top_view_fixture.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::math::TPose3D;

using ViewPanes = TopViewTest;

TEST_F(ViewPanes, ShareThePictureAndFollowSeparateRobots) {
  Panes panes(world, fleet, {makePane(false, std::nullopt, world), makePane(false, 0, world)}, {});
  panes.resize(804, 400);
  const cv::Mat picture = panes.draw(snapshot, paths);
  ASSERT_EQ(picture.size(), cv::Size(804, 400));
  // The right pane, 402 px wide, has the first robot in its middle; the left one shows the whole hall.
  const cv::Vec3b middle = picture.at<cv::Vec3b>(200, 404 + 200 - 20);
  EXPECT_GT(middle[2], 2 * middle[0]) << "red";
}

TEST_F(ViewPanes, LastRowOfPanesIsAsWideAsThePicture) {
  const Pane pane = makePane(false, std::nullopt, world);
  Panes panes(world, fleet, {pane, pane, pane}, {});
  panes.resize(804, 804);
  const cv::Mat picture = panes.draw(snapshot, paths);
  const auto& between = picture.at<cv::Vec3b>(200, 401);
  EXPECT_NE(picture.at<cv::Vec3b>(700, 401), between) << "no gap between panes";
  EXPECT_NE(picture.at<cv::Vec3b>(700, 790), between);
}

TEST_F(ViewPanes, ClickingARobotTurns3dPanesThatFollowToIt) {
  TPose3D world_from_camera;
  const auto draw_3d = [&](const CameraInfo& info, const TPose3D& pose, const SeenWorld&, DepthBuffer*) {
    world_from_camera = pose;
    return cv::Mat(static_cast<int>(info.height_px), static_cast<int>(info.width_px), CV_8UC3);
  };
  Panes panes(world, fleet, {makePane(false, std::nullopt, world), makePane(true, 0, world)}, draw_3d);
  panes.resize(1004, 500);
  const auto distance_to = [&](double x, double y) {
    panes.draw(snapshot, paths);
    return std::hypot(world_from_camera.x - x, world_from_camera.y - y);
  };
  const double behind_m = 4 * std::cos(0.45);  // 4 m away, at the elevation of a pane that follows
  EXPECT_NEAR(distance_to(5, 2.5), behind_m, 1e-9);
  const TopViewCamera left = TopViewCamera::showing({0, 10, 0, 5}, 500, 500);
  panes.click(TopView::groundView(snapshot, left).toPixel({8, 4}), snapshot);
  EXPECT_NEAR(distance_to(8, 4), behind_m, 1e-9);
}

TEST_F(ViewPanes, DraggingPansAndClickingFollowsARobot) {
  Panes panes(world, fleet, {makePane(false, std::nullopt, world)}, {});
  panes.resize(1048, 700);
  const TPoint2D bob = TopView::groundView(snapshot, camera).toPixel({8, 4});
  panes.drag(bob, {-100, 50}, Panes::Drag::turn);
  // Clicks on the robot at its position after the drag.
  panes.click(bob + TPoint2D(-100, 50), snapshot);
  const cv::Mat picture = panes.draw(snapshot, paths);
  const auto& blue = picture.at<cv::Vec3b>(349 + 25, 523);
  EXPECT_GT(blue[0], 2 * blue[2]) << "the second robot, which is blue, is in the middle now";
}

TEST_F(ViewPanes, RequestsOnlyReadingsOfFollowedRobotsWhenThereAreMany) {
  fleet.robots.resize(21, fleet.robots[0]);
  EXPECT_EQ(Panes(world, fleet, {makePane(false, 3, world)}, {}).requestedReadings()[3], 1);
  EXPECT_EQ(Panes(world, fleet, {makePane(false, 3, world)}, {}).requestedReadings()[4], 0);
  fleet.robots.resize(20);
  EXPECT_TRUE(Panes(world, fleet, {makePane(false, 3, world)}, {}).requestedReadings().empty()) << "all";
}

TEST_F(ViewPanes, Pane3dOfAnySizeInitiallyShowsTheWholeWorld) {
  WorldObject tower = world.objects[0];
  tower.body.height_m = 4;
  tower.body.center_z_m = 2;
  world.objects.push_back(tower);
  for (const cv::Size size : {cv::Size(500, 600), {600, 600}, {900, 600}, {1280, 400}}) {
    CameraInfo camera_info;
    mrpt::math::TPose3D world_from_camera;
    Panes panes(world, fleet, {makePane(true, std::nullopt, world)},
                [&](const CameraInfo& info, const mrpt::math::TPose3D& pose, const SeenWorld&, DepthBuffer*) {
                  camera_info = info;
                  world_from_camera = pose;
                  return cv::Mat(cv::Size(size), CV_8UC3);
                });
    panes.resize(size.width, size.height);
    /// Largest distance of a corner from the picture's centre: 1 is the picture's edge.
    const auto farthest = [&] {
      panes.draw(snapshot, paths);
      double share = 0;
      for (const double x : {0.0, 10.0}) {
        for (const double y : {0.0, 5.0}) {
          for (const double z : {0.0, 4.0}) {
            const auto p = world_from_camera.inverseComposePoint({x, y, z});
            EXPECT_GT(p.x, 0) << "ahead";
            const double px_per_slope = camera_info.focalLength();
            share = std::max({share, std::abs(p.y) / p.x * px_per_slope / (size.width / 2.0),
                              std::abs(p.z) / p.x * px_per_slope / (size.height / 2.0)});
          }
        }
      }
      return share;
    };
    EXPECT_LE(farthest(), 1) << size.width << " × " << size.height;
    EXPECT_GE(farthest(), 0.9) << "and not smaller than necessary";
    panes.zoom({10, 10}, 3);
    EXPECT_GT(farthest(), 1);
    panes.showAll();
    EXPECT_LE(farthest(), 1) << size.width << " × " << size.height;
  }
}

TEST(OrbitCamera, FacesItsTarget) {
  OrbitCamera camera;
  camera.target = {3, 4};
  camera.distance_m = 10;
  camera.azimuth_rad = -std::numbers::pi / 2;  // south of it
  camera.elevation_rad = std::numbers::pi / 6;
  const auto pose = camera.worldFromCamera(nullptr);
  EXPECT_NEAR(pose.x, 3, 1e-12);
  EXPECT_NEAR(pose.y, 4 - 10 * std::cos(std::numbers::pi / 6), 1e-12);
  EXPECT_NEAR(pose.z, 5, 1e-12);
  const auto ahead = pose.composePoint({10, 0, 0});
  EXPECT_NEAR(ahead.x, 3, 1e-9);
  EXPECT_NEAR(ahead.y, 4, 1e-9);
  EXPECT_NEAR(ahead.z, 0, 1e-9);
}

TEST(OrbitCamera, FollowsBehindARobot) {
  OrbitCamera camera;
  camera.distance_m = 2;
  camera.elevation_rad = 0.5;
  const TPose2D robot(1, 2, 0.3);
  const auto pose = camera.worldFromCamera(&robot);
  const auto in_robot = robot.inverseComposePoint({pose.x, pose.y});
  EXPECT_NEAR(in_robot.x, -2 * std::cos(0.5), 1e-12);
  EXPECT_NEAR(in_robot.y, 0, 1e-12);
  EXPECT_NEAR(std::remainder(pose.yaw - 0.3, 2 * std::numbers::pi), 0, 1e-12);
}

}  // namespace
}  // namespace robosim
