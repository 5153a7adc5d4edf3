#include "rendering/air_overlay.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace robosim {
namespace {

/// A camera 2 m above the ground, 5 m behind the origin, that looks along x, and a robot that came from (0, -1).
struct AirOverlay : testing::Test {
  AirOverlay() {
    camera.width_px = 400;
    camera.height_px = 300;
    camera.field_of_view_rad = 1;
    FleetRobot robot;
    robot.info.name = "Zoë";
    robot.own_body = Body{Cylinder{0.25}, {0, 0, 0}, 0.2, 0.4};
    robot.color = {1, 0, 0};
    SensorInfo laser;
    laser.kind = SensorKind::laser;
    laser.range_max_m = 8;
    laser.beams.resize(3, {{0, 0, 0.3, 0, 0, 0}});
    robot.info.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{laser});
    fleet.robots.push_back(robot);
    paths.add(0, 0, {{0, -1, 0}});
    paths.add(1, 0.1, {{0, -0.5, 0}});
    snapshot.step = 2;
    snapshot.time_s = 0.2;
    snapshot.robots.resize(1);
    snapshot.robots[0].readings.emplace();
    Echoes echoes(3);
    for (int i = 0; i < 3; ++i) echoes[static_cast<std::size_t>(i)] = {2, {2, static_cast<float>(i) - 1, 0.3f}};
    snapshot.robots[0].readings->measurements.push_back(echoes);
  }

  /// Number of changed pixels with these layers, behind a wall that fills the picture at this depth; 0 for none.
  int changed(const ViewLayers& layers, double wall_m) {
    cv::Mat picture(300, 400, CV_8UC3, cv::Scalar(200, 200, 200));
    const cv::Mat before = picture.clone();
    constexpr double n = kNearPlane_m, f = kFarPlane_m;
    const float depth_value = wall_m > 0 ? static_cast<float>((f - n * f / wall_m) / (f - n)) : 1;
    const DepthBuffer depth{400, 300, std::vector<float>(400UL * 300, depth_value)};
    drawAirOverlay({picture, depth, camera, {-5, 0, 2, 0, 0.35, 0}}, snapshot, fleet, paths, layers, {});
    cv::Mat differs;
    cv::absdiff(picture, before, differs);
    return cv::countNonZero(differs.reshape(1));
  }

  /// The paths alone, on black.
  cv::Mat drawnPaths() {
    cv::Mat picture(300, 400, CV_8UC3, cv::Scalar(0, 0, 0));
    const DepthBuffer sky{400, 300, std::vector<float>(400UL * 300, 1)};
    const ViewLayers layers{.paths = true, .sensors = false, .names = false};
    drawAirOverlay({picture, sky, camera, {-5, 0, 2, 0, 0.35, 0}}, snapshot, fleet, paths, layers, {});
    return picture;
  }

  CameraInfo camera;
  Fleet fleet;
  RunSnapshot snapshot;
  RunPaths paths;
};

TEST_F(AirOverlay, FadesOldPathsWhereTheyCoverThePicture) {
  // Robots drive to and fro along y on lines 2 cm apart; later than the first 20 s of this they are old.
  std::uint64_t step = 2;
  const auto ride = [&](int lines) {
    for (int i = 0; i < lines; ++i) {
      for (const double y : {-0.9, 0.9}) {
        ++step;
        paths.add(step, 0.1 * static_cast<double>(step), {{0.02 * i - 1, i % 2 == 0 ? y : -y, 0}});
      }
    }
    snapshot.step = step;
    snapshot.time_s = 0.1 * static_cast<double>(step) + 25;
    snapshot.robots[0].world_from_robot = {0.02 * lines - 1, 0, 0};
    cv::Mat pixels = drawnPaths();
    cv::Scalar sum = cv::sum(pixels);
    return sum[0] / sum[2];  // blue relative to red
  };
  const double few = ride(2);
  const double many = ride(100);
  EXPECT_GT(many, few + 0.3) << "mixed with the white of the floor";
  EXPECT_LT(many, 0.95) << "but still reddish";
}

TEST_F(AirOverlay, HidesPathsAndRangesBehindNearerThings) {
  const ViewLayers path{.paths = true, .sensors = false, .names = false};
  EXPECT_GT(changed(path, 0), 100) << "before the sky";
  EXPECT_GT(changed(path, 20), 100) << "before a far wall";
  EXPECT_EQ(changed(path, 2), 0) << "behind a near wall";
  const ViewLayers ranges{.paths = false, .sensors = true, .names = false};
  EXPECT_GT(changed(ranges, 20), 1000);
  EXPECT_EQ(changed(ranges, 2), 0);
}

TEST_F(AirOverlay, WritesNamesAboveRobotsAlsoBehindThings) {
  const ViewLayers names{.paths = false, .sensors = false, .names = true};
  EXPECT_GT(changed(names, 20), 200);
  EXPECT_EQ(changed(names, 2), changed(names, 20));
}

TEST_F(AirOverlay, WritesANameBelowOrBesideARobotWithoutRoomAbove) {
  // The camera looks ahead at the top of a robot whose name above it would leave the picture.
  const auto writes_name = [&](double pitch_rad) {
    cv::Mat picture(300, 400, CV_8UC3, cv::Scalar(200, 200, 200));
    const cv::Mat before = picture.clone();
    const DepthBuffer sky{400, 300, std::vector<float>(400UL * 300, 1)};
    drawAirOverlay({picture, sky, camera, {-5, 0, 2, 0, pitch_rad, 0}}, snapshot, fleet, paths,
                   {.paths = false, .sensors = false, .names = true}, {});
    return cv::norm(picture, before, cv::NORM_INF) > 50;
  };
  const double level_rad = std::atan2(2.0, 5.0);
  EXPECT_TRUE(writes_name(level_rad));
  // Half of the picture's height is 300 px of a focal length of f px: the robot is 6 px below the upper edge.
  const double upper_rad = std::atan2(150.0 - 6, camera.focalLength());
  const auto& body = fleet.robots[0].body().heights();
  const double top_rad = std::atan2(2 - body.z_max_m - 0.12, 5.0);
  EXPECT_TRUE(writes_name(top_rad + upper_rad));
}

TEST_F(AirOverlay, DrawsNothingWithoutLayers) {
  EXPECT_EQ(changed({.paths = false, .sensors = false, .names = false}, 20), 0);
}

}  // namespace
}  // namespace robosim
