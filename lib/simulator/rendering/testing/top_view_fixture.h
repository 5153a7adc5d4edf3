#pragma once
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "rendering/top_view.h"
#include "robots/robot_colors.h"

namespace robosim {

/// 10 m × 5 m with a blue box of 2 m × 1 m in its lower left quarter, and two robots of 0.5 m radius.
struct TopViewTest : testing::Test {
  TopViewTest() {
    world.name = "hall";
    world.bounds = {0, 10, 0, 5};
    WorldObject box;
    box.name = "box";
    box.body = {Cube{2, 1}, {2, 1.5, 0}, 0.5, 1, {0, 0, 1}, 0};
    world.objects = {box};
    for (const char* name : {"Ann", "Bob"}) {
      FleetRobot robot;
      robot.info.name = name;
      robot.info.radius_m = 0.5;
      SensorInfo sonar;
      sonar.kind = SensorKind::sonar;
      sonar.label = "sonar";
      sonar.range_max_m = sonar.no_echo_m = 3;
      sonar.beam_width_rad = 0.4;
      sonar.beams = {{{0.5, 0, 0.2, 0, 0, 0}}};
      robot.info.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{sonar});
      robot.color = paletteColor(fleet.robots.size());
      fleet.robots.push_back(robot);
    }
    snapshot.robots.resize(2);
    snapshot.robots[0].world_from_robot = {5, 2.5, 0};
    snapshot.robots[1].world_from_robot = {8, 4, std::numbers::pi / 2};
  }

  cv::Vec3b at(const cv::Mat& picture, const mrpt::math::TPoint2D& world_point) const {
    const mrpt::math::TPoint2D pixel = TopView::groundView(snapshot, camera).toPixel(world_point);
    return picture.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y)), static_cast<int>(std::lround(pixel.x)));
  }

  World world;
  Fleet fleet;
  RunSnapshot snapshot;
  RunPaths paths;
  TopViewCamera camera = TopViewCamera::showing({0, 10, 0, 5}, 1048, 700);
  ViewLayers layers{.paths = true, .sensors = true, .names = false, .paths_from_s = 0};
};

}  // namespace robosim
