#include "rendering/panes.h"

#include <memory>

#include <gtest/gtest.h>

namespace robosim {
namespace {

/// Three robots with cameras at x = 1, 2 and 3 m; the first is absent.
struct AbsentFirst {
  World world;
  Fleet fleet;
  RunSnapshot snapshot;
  std::vector<double> rendered_x_m;  ///< positions of the rendered cameras

  AbsentFirst() {
    world.bounds = {0, 10, 0, 10};
    SensorInfo camera;
    camera.kind = SensorKind::camera;
    camera.beams.resize(1);
    camera.camera.width_px = 160;
    camera.camera.height_px = 120;
    for (int i = 0; i < 3; ++i) {
      FleetRobot robot;
      robot.info.name = "Robot" + std::to_string(i + 1);
      robot.info.radius_m = 0.2;
      robot.info.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector{camera});
      fleet.robots.push_back(robot);
      snapshot.robots.emplace_back().world_from_robot = {1.0 + i, 5, 0};
    }
    snapshot.robots[0].activity = Activity::absent;
    panes.resize(640, 480);
    panes.look().camera_inset = true;
  }

  Panes panes{world,
              fleet,
              {makePane(false, std::nullopt, world)},
              [this](const CameraInfo& camera, const mrpt::math::TPose3D& world_from_camera, auto, DepthBuffer*) {
                rendered_x_m.push_back(world_from_camera.x);
                return cv::Mat(static_cast<int>(camera.height_px), static_cast<int>(camera.width_px), CV_8UC3,
                               cv::Scalar(0, 0, 0));
              }};
};

TEST(Panes, ShowTheCameraPictureOfTheFirstPresentRobot) {
  AbsentFirst scene;
  scene.panes.draw(scene.snapshot, RunPaths());
  EXPECT_EQ(scene.rendered_x_m, std::vector{2.0});
}

TEST(Panes, SkipAbsentRobotsWhenTheyFollowTheNext) {
  AbsentFirst scene;
  for (int i = 0; i < 3; ++i) {
    scene.panes.followNext(scene.snapshot);
    scene.panes.draw(scene.snapshot, RunPaths());
  }
  EXPECT_EQ(scene.rendered_x_m, (std::vector{2.0, 3.0, 2.0}));
}

TEST(Panes, ShowAnotherCameraWhileTheFollowedRobotIsAbsent) {
  AbsentFirst scene;
  scene.panes.followNext(scene.snapshot);
  scene.panes.followNext(scene.snapshot);
  scene.snapshot.robots[2].activity = Activity::absent;
  scene.panes.draw(scene.snapshot, RunPaths());
  EXPECT_EQ(scene.rendered_x_m, std::vector{2.0});
  for (auto& robot : scene.snapshot.robots) robot.activity = Activity::absent;
  scene.panes.followNext(scene.snapshot);
  scene.panes.draw(scene.snapshot, RunPaths());
  EXPECT_EQ(scene.rendered_x_m.size(), 1U) << "no camera is present";
}

}  // namespace
}  // namespace robosim
