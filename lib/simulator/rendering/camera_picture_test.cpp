// Pictures of cameras: OffscreenRenderer::take().
#include <cmath>
#include <future>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/angle_units.h"
#include "rendering/offscreen_renderer.h"

namespace robosim {
namespace {

LoadedWorld smallMaze() { return loadWorld(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", {}); }

std::vector<mrpt::math::TPose2D> startPoses(const Fleet& fleet) {
  std::vector<mrpt::math::TPose2D> poses;
  for (const auto& robot : fleet.robots) poses.push_back(robot.world_from_start);
  return poses;
}

TEST(CameraPicture, MayBeTakenBySeveralThreads) {
  const LoadedWorld maze = smallMaze();
  const auto poses = startPoses(maze.fleet);
  OffscreenRenderer renderer(maze.world, maze.fleet);
  const auto take = [&](unsigned width_px) {
    std::string last;
    for (int i = 0; i < 10; ++i) {
      const CameraView camera{.info = {width_px, 120, 1, 10}, .robot_from_camera = {0.2, 0, 0.3, 0, 0, 0}};
      std::vector<std::string> jpegs(2);
      const std::vector<std::uint32_t> both{0, 1};
      renderer.take(camera, poses, both, jpegs);
      EXPECT_TRUE(last.empty() || jpegs[1] == last);
      last = jpegs[1];
    }
    return last;
  };
  const std::string narrow = take(100), wide = take(200);
  auto first = std::async(std::launch::async, take, 100), second = std::async(std::launch::async, take, 200);
  EXPECT_EQ(first.get(), narrow);
  EXPECT_EQ(second.get(), wide);
}

TEST(CameraPicture, HasTheJpegQuality) {
  const LoadedWorld maze = smallMaze();
  OffscreenRenderer renderer(maze.world, maze.fleet);
  const auto size = [&](int quality) {
    const CameraView camera{
        .info = {320, 240, M_PI / 2, 10}, .robot_from_camera = {0.2, 0, 0.3, 0, 0, 0}, .jpeg_quality = quality};
    std::string jpeg;
    const std::uint32_t robot = 0;
    renderer.take(camera, startPoses(maze.fleet), {&robot, 1}, {&jpeg, 1});
    EXPECT_TRUE(jpeg.starts_with("\xFF\xD8") && jpeg.ends_with("\xFF\xD9"));
    return jpeg.size();
  };
  EXPECT_LT(2 * size(20), size(95));
}

/// The picture of the first robot's camera.
std::string pictureOf(OffscreenRenderer& renderer, const Fleet& fleet, const CameraView& camera) {
  std::string jpeg;
  const std::uint32_t robot = 0;
  renderer.take(camera, startPoses(fleet), {&robot, 1}, {&jpeg, 1});
  return jpeg;
}

TEST(CameraPicture, FollowsTheHeadAsIfTheCameraWasMountedSo) {
  const LoadedWorld maze = smallMaze();
  OffscreenRenderer renderer(maze.world, maze.fleet);
  const auto picture = [&](double yaw_deg, double tilt_deg, double field_of_view_deg, std::vector<CameraAim> aims,
                           bool is_antialiased, const LensDistortion& lens) {
    CameraView camera{.info = {160, 120, toRadians(field_of_view_deg), 10, lens},
                      .robot_from_camera = {0.2, 0.1, 0.3, toRadians(yaw_deg), -toRadians(tilt_deg), 0},
                      .is_antialiased = is_antialiased,
                      .aims = std::move(aims)};
    if (camera.hasErrors()) camera.moment = {.seeds = {1}, .turn_radps = {0}};
    return pictureOf(renderer, maze.fleet, camera);
  };
  const CameraAim aim{toRadians(30), toRadians(-10), 2};
  for (const bool is_antialiased : {false, true}) {
    const std::string mounted = picture(20 + 30, 5 - 10, 60 / 2, {}, is_antialiased, {});
    EXPECT_EQ(picture(20, 5, 60, {aim}, is_antialiased, {}), mounted);
    EXPECT_EQ(picture(20 + 30, 5 - 10, 60 / 2, {CameraAim{}}, is_antialiased, {}), mounted);
    EXPECT_NE(picture(20, 5, 60, {CameraAim{}}, is_antialiased, {}), mounted);
  }
  const LensDistortion lens{-0.1, 0, 0, 0, 0};
  const auto decoded = [](const std::string& jpeg) {
    return cv::imdecode(std::vector<char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
  };
  // With a lens, both are taken from rendered pictures of different sizes.
  EXPECT_LT(cv::norm(decoded(picture(20, 5, 60, {aim}, false, lens)), decoded(picture(50, -5, 30, {}, false, lens)),
                     cv::NORM_L1) /
                (160 * 120 * 3),
            0.5);
}

TEST(CameraPicture, HasMixedColoursAlongEdgesIfAntialiased) {
  // A dark wall to the left of x = 3, whose edge crosses the picture obliquely: its foot, seen from above.
  World world;
  world.bounds = {-10, 10, -10, 10};
  Body wall;
  wall.shape = Cube{0.2, 6};
  wall.world_from_body = {3, 0, 0.4};
  wall.height_m = 1.5;
  wall.center_z_m = 0.75;
  wall.color = {0.05f, 0.05f, 0.05f};
  world.objects.push_back({.name = "wall", .body = wall, .line = {}});
  const Fleet fleet = smallMaze().fleet;
  OffscreenRenderer renderer(world, fleet);
  // The top edge of the wall against the sky. Between the sky and the wall an antialiased picture has in-between
  // colours in most columns, the other one only where lossy compression adds some.
  const auto mixed_columns = [&](bool is_antialiased) {
    const CameraView camera{.info = {320, 240, M_PI / 2, 10},
                            .robot_from_camera = {0, 0, 0.3, 0, 0, 0},
                            .jpeg_quality = 100,
                            .is_antialiased = is_antialiased};
    std::vector<mrpt::math::TPose2D> one(fleet.robots.size(), kNotShown);
    one[0] = {0, 0, 0};
    const std::uint32_t robot = 0;
    std::string jpeg;
    renderer.take(camera, one, {&robot, 1}, {&jpeg, 1});
    const cv::Mat picture = cv::imdecode(std::vector<char>(jpeg.begin(), jpeg.end()), cv::IMREAD_GRAYSCALE);
    EXPECT_EQ(picture.size(), cv::Size(320, 240));
    int mixed = 0;
    for (int x = 100; x < 220; ++x) {
      const int sky = picture.at<uchar>(2, x), dark = 14;  // the wall, which is nearly black
      for (int y = 2; y < 80; ++y) {
        const double share = (picture.at<uchar>(y, x) - dark) / static_cast<double>(sky - dark);
        if (share <= 0.2 || share >= 0.8) continue;
        ++mixed;
        break;
      }
    }
    return mixed;
  };
  EXPECT_LT(mixed_columns(false), 12);
  EXPECT_GT(mixed_columns(true), 40);
}

}  // namespace
}  // namespace robosim
