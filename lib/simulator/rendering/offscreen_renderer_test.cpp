#include "rendering/offscreen_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>
#include <mrpt/poses/CPose3D.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/angle_units.h"
#include "base/random.h"
#include "geometry/scene.h"
#include "rendering/blob_search.h"
#include "sensors/blob_finder.h"

namespace robosim {
namespace {

using mrpt::math::TPoint3D;
using mrpt::math::TPose2D;
using mrpt::math::TPose3D;

// Worlds

World emptyWorld() {
  World world;
  world.bounds = {-10, 10, -10, 10};
  return world;
}

/// A box from (x_min, y_min) to (x_max, y_max) that stands on the ground.
void addBox(World& world, const Bounds2D& plan, double height_m, const std::array<float, 3>& color) {
  Body body;
  body.shape = Cube{plan.x_max - plan.x_min, plan.y_max - plan.y_min};
  body.world_from_body = {(plan.x_min + plan.x_max) / 2, (plan.y_min + plan.y_max) / 2, 0};
  body.height_m = height_m;
  body.center_z_m = height_m / 2;
  body.color = color;
  world.objects.push_back({.name = "box", .body = body, .line = {}});
}

LoadedWorld shipped(const std::string& name) { return loadWorld(ROBOSIM_SOURCE_DIR "/worlds/" + name, {}); }

std::vector<TPose2D> starts(const Fleet& fleet) {
  std::vector<TPose2D> poses;
  for (const auto& robot : fleet.robots) poses.push_back(robot.world_from_start);
  return poses;
}

// Pictures

/// 320 × 240 pixels with a focal length of 160 pixels: a point at 45° is on the picture's edge.
constexpr CameraInfo kCamera{320, 240, M_PI / 2, 10};

/// A camera at a height, facing along x.
TPose3D at(double x_m, double y_m, double z_m, double yaw_rad = 0, double down_rad = 0) {
  return {x_m, y_m, z_m, yaw_rad, down_rad, 0};
}

cv::Vec3b pixel(const cv::Mat& picture, int row, int column) { return picture.at<cv::Vec3b>(row, column); }

double difference(const cv::Vec3b& a, const cv::Vec3b& b) { return cv::norm(cv::Vec3i(a) - cv::Vec3i(b)); }

/// Columns at which a row's colour changes, from left to right: first column of each new colour.
std::vector<int> jumpsInRow(const cv::Mat& picture, int row) {
  std::vector<int> jumps;
  for (int column = 1; column < picture.cols; ++column) {
    if (difference(pixel(picture, row, column - 1), pixel(picture, row, column)) > 30) jumps.push_back(column);
  }
  return jumps;
}

std::vector<int> jumpsInColumn(const cv::Mat& picture, int column) {
  cv::Mat turned;
  cv::transpose(picture, turned);
  return jumpsInRow(turned, column);
}

/// The first pixel whose centre is beyond an edge at `edge_px` from the left, or the top.
int firstBeyond(double edge_px) { return static_cast<int>(std::ceil(edge_px - 0.5)); }

double brightness(const cv::Vec3b& color) { return (color[0] + color[1] + color[2]) / 3.0; }

TEST(OffscreenRenderer, DrawsEdgesAtTheExpectedPixels) {
  World world = emptyWorld();
  addBox(world, {2, 2.2, -0.333, 0.777}, 1.5, {0.8f, 0.1f, 0.1f});
  OffscreenRenderer renderer(world, {});
  const cv::Mat picture = renderer.picture(kCamera, at(0, 0, 0.5), {});
  ASSERT_EQ(picture.size(), cv::Size(320, 240));
  // The visible face is 2 m ahead: a metre is 80 pixels. Its left edge is at y = 0.777. Above the horizon, out of its
  // shadow, it borders on sky only.
  EXPECT_EQ(jumpsInRow(picture, 100), (std::vector<int>{firstBeyond(160 - 80 * 0.777), firstBeyond(160 + 80 * 0.333)}));
  // Its top is 1 m above the camera, its foot 0.5 m below it.
  EXPECT_EQ(jumpsInColumn(picture, 160), (std::vector<int>{firstBeyond(120 - 80), firstBeyond(120 + 80 * 0.5)}));
}

TEST(OffscreenRenderer, DrawsTheHorizonAtZeroElevation) {
  World world = emptyWorld();
  world.bounds = {-1000, 1000, -1000, 1000};  // moves the floor's edge beyond the horizon
  OffscreenRenderer renderer(world, {});
  for (const double down_rad : {0.0, 0.1, 0.25, -0.2}) {
    const cv::Mat picture = renderer.picture(kCamera, at(-30, 0, 0.3, 1, down_rad), {});
    const int horizon = firstBeyond(120 - 160 * std::tan(down_rad));
    for (const int column : {1, 160, 318}) {
      EXPECT_EQ(jumpsInColumn(picture, column).at(0), horizon) << down_rad << " rad down, column " << column;
    }
  }
}

TEST(OffscreenRenderer, UsesTheCamerasMountingPose) {
  const LoadedWorld maze = shipped("small_maze.xml");
  OffscreenRenderer renderer(maze.world, maze.fleet);
  auto poses = starts(maze.fleet);
  poses[1] = {0.3, -0.2, 1.1};
  const CameraView camera{.info = kCamera, .robot_from_camera = {0.2, 0.1, 0.4, 0.5, 0.2, 0}, .jpeg_quality = 100};
  std::string jpeg;
  const std::uint32_t second = 1;
  renderer.take(camera, poses, {&second, 1}, {&jpeg, 1});
  const auto world_from_camera =
      mrpt::poses::CPose3D(0.3, -0.2, 0, 1.1, 0, 0) + mrpt::poses::CPose3D(0.2, 0.1, 0.4, 0.5, 0.2, 0);
  const cv::Mat expected = renderer.picture(kCamera, world_from_camera.asTPose(), poses);
  const cv::Mat taken = cv::imdecode(std::vector<char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
  ASSERT_EQ(taken.size(), expected.size());
  EXPECT_LT(cv::norm(taken, expected, cv::NORM_L1) / static_cast<double>(expected.total() * 3), 2);
}

// Depth

/// Reference depth of a pixel by ray casting; nullopt for the sky.
class ExactDepth {
 public:
  explicit ExactDepth(const World& world) : scene_(solidsOf(world), 0, world.bounds) {}

  std::optional<double> of(double column, double row, const mrpt::poses::CPose3D& world_from_camera) const {
    const double right = (column - 160) / 160, down = (row - 120) / 160;
    const double length = std::sqrt(1 + right * right + down * down);
    const TPoint3D eye(world_from_camera.x(), world_from_camera.y(), world_from_camera.z());
    const auto towards =
        world_from_camera.rotateVector(mrpt::math::TVector3D(1 / length, -right / length, -down / length));
    const Hit hit = scene_.castRay({eye, {towards.x, towards.y, towards.z}}, 1000);
    double range_m = hit.distance_m;
    if (towards.z < 0) range_m = std::min(range_m, -eye.z / towards.z);
    if (!std::isfinite(range_m)) return std::nullopt;
    return range_m / length;
  }

 private:
  static std::vector<Solid> solidsOf(const World& world) {
    std::vector<Solid> solids;
    for (const auto& object : world.objects) solids.push_back(object.body.solid());
    return solids;
  }
  Scene scene_;
};

TEST(OffscreenRenderer, DepthMatchesExactRays) {
  const World world = shipped("opho2_1.xml").world;
  const ExactDepth exact(world);
  OffscreenRenderer renderer(world, {});
  Rng rng(1);
  int compared = 0, skipped = 0;
  double worst = 0;
  for (int place = 0; place < 12; ++place) {
    const TPose3D pose(rng.uniform(-9.5, 9.5), rng.uniform(-9.5, 9.5), rng.uniform(0.2, 1.5), rng.uniform(-M_PI, M_PI),
                       rng.uniform(-0.2, 0.5), 0);
    const mrpt::poses::CPose3D world_from_camera(pose);
    const cv::Mat depth = renderer.depth(kCamera, pose, {});
    for (int row = 0; row < 240; row += 3) {
      for (int column = 0; column < 320; column += 3) {
        const auto expected = exact.of(column + 0.5, row + 0.5, world_from_camera);
        // At an edge a pixel may show either side; objects nearer than the near plane are not drawn.
        const auto is_smooth = [&](double x, double y) {
          const auto before = exact.of(column + 0.5 - x, row + 0.5 - y, world_from_camera);
          const auto after = exact.of(column + 0.5 + x, row + 0.5 + y, world_from_camera);
          if (!before || !expected || !after) return !before && !expected && !after;
          return std::abs((*before + *after) / 2 / *expected - 1) < 0.002;
        };
        if (!is_smooth(0.4, 0) || !is_smooth(0, 0.4) || (expected && *expected < 0.03)) {
          ++skipped;
          continue;
        }
        ++compared;
        const double drawn = depth.at<float>(row, column);
        if (!expected || *expected > 100) continue;
        worst = std::max(worst, std::abs(drawn / *expected - 1));
        ASSERT_NEAR(drawn / *expected, 1, 0.005)
            << "place " << place << ", row " << row << ", column " << column << ": " << *expected << " m";
      }
    }
  }
  EXPECT_GT(compared, 5 * skipped);
  RecordProperty("worst_ppm", static_cast<int>(worst * 1e6));
}

TEST(OffscreenRenderer, DepthOfTheSkyIsZero) {
  OffscreenRenderer renderer(emptyWorld(), {});
  const cv::Mat depth = renderer.depth(kCamera, at(0, 0, 1), {});
  EXPECT_EQ(depth.at<float>(60, 160), 0);
  EXPECT_NEAR(depth.at<float>(199, 160), 160 / 79.5, 0.001);  // the ground, 1 m below the camera
}

// Appearance

TEST(OffscreenRenderer, ShadesWallsDifferentlyFromGroundSkyAndEachOther) {
  World world = emptyWorld();
  addBox(world, {2, 3, -0.5, 0.5}, 1, {0.6f, 0.6f, 0.6f});
  OffscreenRenderer renderer(world, {});
  // From above its corner: two sides and the top.
  const cv::Mat picture = renderer.picture(kCamera, at(1.3, -1.2, 1.8, M_PI / 4, 0.6), {});
  const auto expected_at = [&](const TPoint3D& point) {
    const mrpt::poses::CPose3D world_from_camera(at(1.3, -1.2, 1.8, M_PI / 4, 0.6));
    const auto p = world_from_camera.inverseComposePoint(point);
    return pixel(picture, static_cast<int>(120 - 160 * p.z / p.x), static_cast<int>(160 - 160 * p.y / p.x));
  };
  const std::vector<cv::Vec3b> faces{expected_at({2, 0, 0.6}), expected_at({2.5, -0.5, 0.6}), expected_at({2.5, 0, 1})};
  const auto ground = expected_at({1.6, -0.6, 0});
  const auto sky = pixel(renderer.picture(kCamera, at(0, 0, 1), {}), 20, 160);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    EXPECT_GT(difference(faces[i], sky), 30) << i;
    EXPECT_GT(difference(faces[i], ground), 10) << i;
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(difference(faces[i], faces[j]), 15) << i << " beside " << j;
  }
}

cv::Vec3b toHsv(const cv::Vec3b& bgr) {
  cv::Mat hsv;
  cv::cvtColor(cv::Mat(1, 1, CV_8UC3, cv::Scalar(bgr[0], bgr[1], bgr[2])), hsv, cv::COLOR_BGR2HSV);
  return hsv.at<cv::Vec3b>(0, 0);
}

TEST(OffscreenRenderer, DrawsColoursOfTheFile) {
  const std::pair<std::array<float, 3>, int> colors[] = {
      {{0.8f, 0.1f, 0.1f}, 0}, {{0.1f, 0.7f, 0.1f}, 60}, {{0.1f, 0.2f, 0.8f}, 115}, {{0.8f, 0.7f, 0.1f}, 26}};
  for (const auto& [color, hue] : colors) {
    World world = emptyWorld();
    addBox(world, {2, 2.2, -1, 1}, 1.5, color);
    OffscreenRenderer renderer(world, {});
    const auto hsv = toHsv(pixel(renderer.picture(kCamera, at(0, 0, 0.5), {}), 110, 160));
    EXPECT_LT(std::min((hsv[0] - hue + 180) % 180, (hue - hsv[0] + 180) % 180), 6) << "hue " << 2 * hue << "°";
    EXPECT_GT(hsv[1], 150);
    EXPECT_GT(hsv[2], 90);
  }
}

TEST(OffscreenRenderer, DrawsGoldWithAMetallicMaterial) {
  const World world = shipped("opho2_1.xml").world;
  OffscreenRenderer renderer(world, {});
  // The gold of opho2_1 is at (0, 1), 0.4 m across and 1 m high; the camera is 2 m south of it, at half its height.
  const cv::Mat picture = renderer.picture(kCamera, at(0, -1, 0.5, M_PI / 2), {});
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", picture, bytes);
  const auto blobs = findBlobs({bytes.begin(), bytes.end()}, {{.name = "gold", .hue_rad = toRadians(47)}}, 4);
  EXPECT_NEAR(blobs[0].x_px, 159.5, 1);
  EXPECT_NEAR(blobs[0].width_px, 2 * 160 * 0.2 / std::sqrt(4 - 0.04), 3);
  EXPECT_NEAR(blobs[0].height_px, 2 * 160 * 0.5 / 1.8, 3);
  // Metallic reflection: on a cylinder of one colour, some pixels are much brighter than others.
  double darkest = 255, brightest = 0;
  for (int column = 148; column <= 171; ++column) {
    darkest = std::min(darkest, brightness(pixel(picture, 115, column)));
    brightest = std::max(brightest, brightness(pixel(picture, 115, column)));
  }
  EXPECT_GT(brightest, 1.25 * darkest);
}

// Robots

/// Two robots of a type, 1.5 m apart, that face each other along x.
LoadedWorld twoOf(const std::string& model) {
  LoadedWorld two;
  two.world = emptyWorld();
  for (const char* name : {"a", "b"}) {
    RobotPlacement robot;
    robot.name = name;
    robot.model = model;
    robot.world_from_robot = name[0] == 'a' ? TPose2D(0, 0, 0) : TPose2D(1.5, 0, M_PI);
    robot.color = name[0] == 'a' ? std::array<float, 3>{0.8f, 0.1f, 0.1f} : std::array<float, 3>{0.1f, 0.8f, 0.2f};
    two.world.robots.push_back(robot);
  }
  ErrorList errors;
  two.fleet = buildFleet(two.world, "two.xml", robotTypesIn({ROBOSIM_SOURCE_DIR "/worlds/robots"}), {}, errors);
  errors.throwIfAny();
  return two;
}

TEST(OffscreenRenderer, DrawsOtherRobots) {
  for (const char* model : {"pioneer3dx_camera", "scout"}) {
    const LoadedWorld two = twoOf(model);
    OffscreenRenderer renderer(two.world, two.fleet);
    const CameraView camera{.info = kCamera, .robot_from_camera = {0.3, 0, 0.35, 0, 0.15, 0}, .jpeg_quality = 95};
    std::vector<std::string> jpegs(2);
    const std::vector<std::uint32_t> both{0, 1};
    renderer.take(camera, starts(two.fleet), both, jpegs);
    const TargetColor red{.name = "red", .hue_rad = 0}, green{.name = "green", .hue_rad = toRadians(128)};
    const auto seen_by_a = findBlobs(jpegs[0], {red, green}, 20), seen_by_b = findBlobs(jpegs[1], {red, green}, 20);
    // Each sees the other straight ahead, in its colour. The distance is 1.2 m, so that a robot's width of 0.4 m is
    // about 50 pixels.
    for (const Blob& blob : {seen_by_a[1], seen_by_b[0]}) {
      EXPECT_GT(blob.pixels, 100u) << model;
      EXPECT_NEAR(blob.x_px, 160, 8) << model;
      EXPECT_NEAR(blob.width_px, 50, 20) << model;
    }
    EXPECT_LT(seen_by_a[0].pixels, 50u) << model;
    EXPECT_LT(seen_by_b[1].pixels, 50u) << model;
  }
}

TEST(OffscreenRenderer, DrawsRobotsAtTheirCurrentPoses) {
  const LoadedWorld two = twoOf("scout");
  OffscreenRenderer renderer(two.world, two.fleet);
  const auto picture = [&](const TPose2D& second) {
    return renderer.picture(kCamera, at(0.5, -1, 0.3), std::vector<TPose2D>{{-5, -5, 0}, second});
  };
  const cv::Mat there = picture({2, -1, 0}), gone = picture({-5, 5, 0}), again = picture({2, -1, 0});
  EXPECT_GT(cv::norm(there, gone, cv::NORM_INF), 50);
  EXPECT_EQ(cv::norm(there, again, cv::NORM_INF), 0);
}

TEST(OffscreenRenderer, DrawsNoAbsentRobot) {
  const LoadedWorld loaded = shipped("small_maze.xml");
  auto poses = starts(loaded.fleet);
  const TPose2D& second = poses[1];
  const TPose3D camera = at(second.x - 1, second.y, 0.5, 0, 0.2);
  OffscreenRenderer renderer(loaded.world, loaded.fleet);
  const cv::Mat with = renderer.picture(kCamera, camera, poses);
  poses[1] = kNotShown;
  const cv::Mat without = renderer.picture(kCamera, camera, poses);
  Fleet others = loaded.fleet;
  others.robots.erase(others.robots.begin() + 1);
  auto other_poses = poses;
  other_poses.erase(other_poses.begin() + 1);
  const cv::Mat never = OffscreenRenderer(loaded.world, others).picture(kCamera, camera, other_poses);
  EXPECT_EQ(cv::norm(without, never, cv::NORM_L1), 0);
  EXPECT_GT(cv::norm(with, without, cv::NORM_L1), 10000);
}

TEST(OffscreenRenderer, MarksARobotsHeading) {
  for (const char* model : {"pioneer3dx", "scout"}) {
    const LoadedWorld two = twoOf(model);
    OffscreenRenderer renderer(two.world, two.fleet);
    const auto picture = [&](double heading_rad) {
      return renderer.picture(kCamera, at(0, 0, 1.5, 0, M_PI / 2),
                              std::vector<TPose2D>{{0, 0, heading_rad}, {-5, 5, 0}});
    };
    EXPECT_GT(cv::norm(picture(0), picture(M_PI), cv::NORM_INF), 60) << model;
    EXPECT_GT(cv::norm(picture(0), picture(M_PI / 2), cv::NORM_INF), 60) << model;
  }
}

TEST(OffscreenRenderer, DrawsAThousandRobotsWithCulling) {
  LoadedWorld two = twoOf("scout");
  std::vector<TPose2D> poses;
  Fleet crowd;
  for (int i = 0; i < 1000; ++i) {
    crowd.robots.push_back(two.fleet.robots[0]);
    poses.emplace_back(-8 + 0.5 * (i % 32), -8 + 0.5 * (i / 32), 0.1 * i);
  }
  OffscreenRenderer renderer(two.world, crowd);
  const cv::Mat all = renderer.picture(kCamera, at(-9, -9, 2, M_PI / 4, 0.5), poses);
  OffscreenRenderer alone(two.world, {});
  const cv::Mat none = alone.picture(kCamera, at(-9, -9, 2, M_PI / 4, 0.5), {});
  cv::Mat changed;
  cv::absdiff(all, none, changed);
  cv::cvtColor(changed, changed, cv::COLOR_BGR2GRAY);
  EXPECT_GT(cv::countNonZero(changed > 20), 320 * 240 / 4);
  EXPECT_EQ(cv::norm(renderer.picture(kCamera, at(-9, -9, 2, -3 * M_PI / 4), poses),
                     alone.picture(kCamera, at(-9, -9, 2, -3 * M_PI / 4), {}), cv::NORM_INF),
            0);
}

// Rendering contexts and threads

TEST(OffscreenRenderer, IsDeterministicAfterOtherPictures) {
  const LoadedWorld maze = shipped("small_maze.xml");
  const auto poses = starts(maze.fleet);
  const auto same = [](const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; };
  OffscreenRenderer renderer(maze.world, maze.fleet);
  const TPose3D eye = at(-4, -3, 0.4, 0.7);
  const cv::Mat first = renderer.picture(kCamera, eye, poses);
  const cv::Mat large = renderer.picture({641, 333, 1, 10}, eye, poses);
  EXPECT_EQ(large.size(), cv::Size(641, 333));
  const cv::Mat tiny = renderer.picture({1, 1, 1, 10}, eye, poses);
  EXPECT_EQ(tiny.size(), cv::Size(1, 1));
  EXPECT_TRUE(same(renderer.picture(kCamera, eye, poses), first));
  {
    OffscreenRenderer other(shipped("opho2_1.xml").world, {});
    EXPECT_FALSE(same(other.picture(kCamera, eye, {}), first));
    EXPECT_TRUE(same(renderer.picture(kCamera, eye, poses), first));
  }
  EXPECT_TRUE(same(renderer.picture(kCamera, eye, poses), first)) << "after another renderer has been destroyed";
  EXPECT_TRUE(same(renderer.picture({641, 333, 1, 10}, eye, poses), large));
}

TEST(OffscreenRenderer, IsDeterministicInAnotherContext) {
  const LoadedWorld maze = shipped("small_maze.xml");
  cv::Mat pictures[2];
  for (auto& picture : pictures) {
    OffscreenRenderer only(maze.world, maze.fleet);  // its destruction ends the render thread
    picture = only.picture(kCamera, at(-4, -3, 0.4, 0.7), starts(maze.fleet));
  }
  EXPECT_EQ(cv::norm(pictures[0], pictures[1], cv::NORM_INF), 0);
}

TEST(HasCamera, DetectsCameras) {
  EXPECT_FALSE(hasCamera(shipped("small_maze.xml").fleet));
  EXPECT_TRUE(hasCamera(twoOf("pioneer3dx_camera").fleet));
}

}  // namespace
}  // namespace robosim
