// Ray-cast pictures beside those of OpenGL.
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "geometry/scene.h"
#include "rendering/offscreen_renderer.h"
#include "sensors/raycast/camera.h"

namespace robosim {
namespace {

/// Boxes and cylinders, some above the floor, within 8 m.
World randomWorld(Rng& rng) {
  World world;
  world.bounds = {-10, 10, -10, 10};
  for (int i = 0; i < 14; ++i) {
    Body body;
    body.shape = Cube{rng.uniform(0.2, 2), rng.uniform(0.2, 2)};
    if (rng.below(2)) body.shape = Cylinder{rng.uniform(0.1, 0.8)};
    body.world_from_body = {rng.uniform(1.5, 8), rng.uniform(-5, 5), rng.uniform(-M_PI, M_PI)};
    body.height_m = rng.uniform(0.1, 1.5);
    body.center_z_m = body.height_m / 2 + (rng.below(3) ? 0 : rng.uniform(0.1, 1));
    world.objects.push_back({.name = "body" + std::to_string(i), .body = body, .line = {}});
  }
  return world;
}

TEST(RaycastView, ShowsEveryEdgeWithinHalfAPixelOfOpenGl) {
  constexpr std::uint32_t kFiner = 8;
  // On the floor and on tops, a row of the finer picture is up to an eighth of the distance. OpenGL's cylinders have 72
  // sides.
  constexpr float kFar_m = 20, kError = 0.15F;
  const CameraInfo coarse{96, 64, 1.2, 10}, fine{kFiner * coarse.width_px, kFiner * coarse.height_px, 1.2, 10};
  std::size_t pixels = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Rng rng(seed);
    const World world = randomWorld(rng);
    const Scene scene(startSolids(world), 0, world.bounds);
    OffscreenRenderer renderer(world, {});
    const mrpt::math::TPose3D pose(0, rng.uniform(-1, 1), rng.uniform(0.1, 1.2), rng.uniform(-0.4, 0.4),
                                   seed % 2 ? 0 : rng.uniform(-0.3, 0.5), 0);
    RaycastPicture picture;
    RaycastCamera(coarse, pose, {.has_rgb = false, .has_depth = true, .range_max_m = 40})
        .take({scene, {}, {.bounds = world.bounds, .areas = {}}}, {}, kNoBody, picture);
    const cv::Mat opengl = renderer.depth(fine, pose, SeenWorld{});
    // Some point of the pixel's own square, half a pixel around its centre, must have its depth in OpenGL.
    for (std::uint32_t row = 0; row < coarse.height_px; ++row) {
      for (std::uint32_t column = 0; column < coarse.width_px; ++column, ++pixels) {
        const float depth = picture.depth_m[std::size_t{row} * coarse.width_px + column];
        const bool is_far = depth == 0 || depth > kFar_m;
        bool is_same = false;
        for (std::uint32_t i = 0; i < kFiner * kFiner && !is_same; ++i) {
          const float other = opengl.at<float>(static_cast<int>(row * kFiner + i / kFiner),
                                               static_cast<int>(column * kFiner + i % kFiner));
          is_same = is_far ? other == 0 || other > kFar_m * (1 - kError) : std::abs(other - depth) <= kError * depth;
        }
        ASSERT_TRUE(is_same) << "seed " << seed << " column " << column << " row " << row << ": " << depth << " m, "
                             << opengl.at<float>(static_cast<int>(row * kFiner + kFiner / 2),
                                                 static_cast<int>(column * kFiner + kFiner / 2));
      }
    }
  }
  EXPECT_EQ(pixels, 6u * 96 * 64);
}

}  // namespace
}  // namespace robosim
