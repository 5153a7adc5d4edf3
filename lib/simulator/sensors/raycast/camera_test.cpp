#include "sensors/raycast/camera.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/testing/vector_widths.h"
#include "geometry/testing/random_scene.h"
#include "sensors/testing/slow_raycast.h"

namespace robosim {
namespace {

constexpr RaycastOptions kAllLayers{.has_rgb = true, .has_depth = true, .has_body = true};

CameraInfo pinhole(std::uint32_t width_px, std::uint32_t height_px, double field_of_view_deg) {
  return {
      .width_px = width_px, .height_px = height_px, .field_of_view_rad = toRadians(field_of_view_deg), .rate_hz = 10};
}

const FloorLook kFloor{.bounds = {-50, 50, -50, 50}, .areas = {}};

RaycastPicture take(const Scene& scene, const CameraInfo& info, const mrpt::math::TPose3D& pose,
                    const RaycastOptions& options = kAllLayers, std::span<const SurfaceLook> looks = {},
                    const FloorLook& floor = kFloor) {
  RaycastPicture picture;
  RaycastCamera(info, pose, options).take({scene, looks, floor}, {}, kNoBody, picture);
  return picture;
}

std::uint32_t bodyAt(const RaycastPicture& picture, std::uint32_t column, std::uint32_t row) {
  return picture.body[std::size_t{row} * picture.width_px + column];
}
float depthAt(const RaycastPicture& picture, std::uint32_t column, std::uint32_t row) {
  return picture.depth_m[std::size_t{row} * picture.width_px + column];
}
Rgb colorAt(const RaycastPicture& picture, std::uint32_t column, std::uint32_t row) {
  const auto* pixel = &picture.rgb[3 * (std::size_t{row} * picture.width_px + column)];
  return {pixel[0], pixel[1], pixel[2]};
}

Solid box(const mrpt::math::TPose2D& pose, double length_m, double width_m, HeightSpan heights) {
  return {OrientedBox::from(pose, length_m, width_m), heights};
}

TEST(RaycastCamera, ShowsABoxWhereItsEdgesProject) {
  // Focal length 32 px. The front face of 1 m × 1 m is 2 m ahead: 16 px wide, from column 24 to 40; its top is 0.5 m
  // above the camera, 8 px, and its underside as much below.
  const Scene scene({box({2.5, 0, 0}, 1, 1, {0, 1})}, 0, {-5, 5, -5, 5});
  const auto picture = take(scene, pinhole(64, 64, 90), {0, 0, 0.5, 0, 0, 0});
  for (std::uint32_t row = 0; row < 64; ++row) {
    for (std::uint32_t column = 0; column < 64; ++column) {
      const bool is_box = 24 <= column && column < 40 && 24 <= row && row < 40;
      const auto ground = row < 32 ? RaycastPicture::kSky : RaycastPicture::kFloor;
      ASSERT_EQ(bodyAt(picture, column, row), is_box ? 0 : ground) << column << ' ' << row;
      const double floor_m = row < 32 ? 0 : 0.5 * 32 / (row + 0.5 - 32);
      ASSERT_FLOAT_EQ(depthAt(picture, column, row), static_cast<float>(is_box ? 2 : floor_m)) << column << ' ' << row;
    }
  }
}

TEST(RaycastCamera, PlacesEdgesWithinAHundredthOfAPixel) {
  // A pixel is 1/16 m wide at 2 m. The left edge of the box lies 0.004 px to the right and to the left of the centre of
  // column 30, its top as much below and above the centre of row 20.
  const double px_m = 2.0 / 32;
  for (const double shift_px : {-0.004, 0.004}) {
    const double left_m = (32 - 30.5 - shift_px) * px_m;
    const double top_m = 0.5 + (32 - 20.5 - shift_px) * px_m;
    const Scene scene({box({2.5, left_m - 0.5, 0}, 1, 1, {0, top_m})}, 0, {-5, 5, -5, 5});
    const auto picture = take(scene, pinhole(64, 64, 90), {0, 0, 0.5, 0, 0, 0});
    const bool is_seen = shift_px < 0;
    EXPECT_EQ(bodyAt(picture, 30, 32) == 0, is_seen) << shift_px;
    EXPECT_NE(bodyAt(picture, 29, 32), 0U);
    EXPECT_EQ(bodyAt(picture, 31, 32), 0U);
    EXPECT_EQ(bodyAt(picture, 33, 20) == 0, is_seen) << shift_px;
    EXPECT_NE(bodyAt(picture, 33, 19), 0U);
    EXPECT_EQ(bodyAt(picture, 33, 21), 0U);
  }
}

TEST(RaycastCamera, ShowsTopsAndUndersidesOfBodiesBelowAndAboveIt) {
  // A table of 0.4 m at 2 m to 4 m, and a shelf from 1.4 m up, seen from 0.9 m.
  const Scene scene({box({3, 0, 0}, 2, 10, {0, 0.4}), box({3, 0, 0}, 2, 10, {1.4, 1.6})}, 0, {-5, 5, -5, 5});
  const auto picture = take(scene, pinhole(64, 64, 90), {0, 0, 0.9, 0, 0, 0});
  // 0.5 m below and above the camera at a depth of 2 m are 8 px, at 4 m 4 px.
  for (std::uint32_t row = 32; row < 64; ++row) {
    const double below_px = row + 0.5 - 32;
    const double front_end_px = 0.9 * 32 / 2;
    const double expected = below_px < 4 || below_px > front_end_px ? 0.9 * 32 / below_px
                            : below_px < 8                          ? 0.5 * 32 / below_px
                                                                    : 2;
    ASSERT_FLOAT_EQ(depthAt(picture, 32, row), static_cast<float>(expected)) << row;
    const std::uint32_t upper = 63 - row;
    const double shelf = below_px < 4 ? 0 : below_px < 8 ? 0.5 * 32 / below_px : below_px < 0.7 * 32 / 2 ? 2 : 0;
    ASSERT_FLOAT_EQ(depthAt(picture, 32, upper), static_cast<float>(shelf)) << upper;
  }
}

TEST(RaycastCamera, SeesNothingBeyondItsRange) {
  const Scene scene({box({2.5, 0, 0}, 1, 1, {0, 1}), box({6.5, 0, 0}, 1, 9, {0, 3})}, 0, {-9, 9, -9, 9});
  RaycastOptions options = kAllLayers;
  options.range_max_m = 5.9;
  const auto near = take(scene, pinhole(64, 64, 90), {0, 0, 0.5, 0, 0, 0}, options);
  EXPECT_EQ(bodyAt(near, 32, 30), 0U);
  EXPECT_EQ(bodyAt(near, 10, 30), RaycastPicture::kSky);
  EXPECT_EQ(depthAt(near, 10, 30), 0);
  EXPECT_EQ(bodyAt(near, 10, 34), RaycastPicture::kSky) << "floor at 6.4 m";
  EXPECT_EQ(bodyAt(near, 10, 35), RaycastPicture::kFloor) << "floor at 4.57 m";
  options.range_max_m = 6.1;
  EXPECT_EQ(bodyAt(take(scene, pinhole(64, 64, 90), {0, 0, 0.5, 0, 0, 0}, options), 10, 30), 1U);
}

TEST(RaycastCamera, DoesNotShowItsOwner) {
  Scene scene({box({4.5, 0, 0}, 1, 9, {0, 1})}, 1, {-9, 9, -9, 9});
  scene.place(0, {Circle{{0, 0}, 0.3}, {0, 0.6}});
  scene.freeze();
  RaycastPicture picture;
  const RaycastCamera camera(pinhole(64, 64, 90), {0, 0, 0.5, 0, 0, 0}, kAllLayers);
  camera.take({scene, {}, kFloor}, {}, scene.movingBody(0), picture);
  EXPECT_EQ(bodyAt(picture, 32, 32), 0U);
  camera.take({scene, {}, kFloor}, {}, kNoBody, picture);
  EXPECT_EQ(bodyAt(picture, 32, 32), 1U) << "from inside";
  EXPECT_EQ(depthAt(picture, 32, 32), 0);
}

TEST(RaycastCamera, ShadesFacesByTheSunAndNotWhatGlows) {
  const Scene scene({box({2.5, 0, 0}, 1, 1, {0, 1})}, 0, {-5, 5, -5, 5});
  std::vector<SurfaceLook> looks{{{200, 100, 50}, true}};
  EXPECT_EQ(colorAt(take(scene, pinhole(64, 64, 90), {0, 0, 0.5, 0, 0, 0}, kAllLayers, looks), 32, 32),
            (Rgb{200, 100, 50}));
  looks[0].glows = false;
  // The face towards -x has the cosine 0.385 to the sun: light (0.7602, 0.7575, 0.7521).
  EXPECT_EQ(colorAt(take(scene, pinhole(64, 64, 90), {0, 0, 0.5, 0, 0, 0}, kAllLayers, looks), 32, 32),
            (Rgb{152, 76, 38}));
}

TEST(RaycastCamera, ShowsTheFieldsOfTheFloorAndWhatIsPaintedOnIt) {
  const Scene scene({}, 0, {-5, 5, -5, 5});
  FloorLook floor{.bounds = {-5, 5, -5, 5}, .areas = {{Circle{{3, 0}, 0.5}, {255, 0, 0}}}};
  const auto picture = take(scene, pinhole(64, 64, 90), {0, 0, 0.5, 0, 0, 0}, kAllLayers, {}, floor);
  // Rows 37 and 36 show the floor at 2.9 m and 3.6 m, row 40 at 1.9 m.
  EXPECT_EQ(colorAt(picture, 32, 37), (Rgb{255, 0, 0}));
  EXPECT_NE(colorAt(picture, 32, 36), (Rgb{255, 0, 0}));
  const Rgb right = colorAt(picture, 32, 40), left = colorAt(picture, 31, 40);
  EXPECT_NE(right, left) << "on both sides of y = 0";
  EXPECT_EQ(colorAt(picture, 50, 34), (Rgb{153, 161, 140})) << "beyond the bounds";
}

struct RandomView {
  CameraInfo info;
  mrpt::math::TPose3D robot_from_camera;
  PlanarTransform world_from_robot;
  RaycastOptions options = kAllLayers;
};

/// A level camera, or one that is tilted, rolled, or has a lens.
RandomView randomView(Rng& rng, bool is_level, const Bounds2D& area) {
  RandomView view;
  view.info = pinhole(1 + rng.below(70), 1 + rng.below(50), rng.uniform(20, 130));
  const auto from = randomPoint(rng, area);
  view.world_from_robot = PlanarTransform({from.x, from.y, rng.uniform(-M_PI, M_PI)}, rng.uniform(0, 0.1));
  view.robot_from_camera = {
      rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), rng.uniform(0.05, 1.5), rng.uniform(-M_PI, M_PI), 0, 0};
  if (!is_level) {
    view.robot_from_camera.pitch = rng.uniform(-M_PI / 2, M_PI / 2);
    if (rng.below(2)) view.robot_from_camera.roll = rng.uniform(-M_PI, M_PI);
    if (rng.below(4) == 0 && view.info.field_of_view_rad < 1.2) view.info.distortion = {-0.1, 0.01, 0.001, -0.001, 0};
  }
  if (rng.below(3) == 0) view.options.range_max_m = rng.uniform(1, 10);
  return view;
}

/// Compares a picture with the reference: where they differ, some ray within a hundredth of a pixel must see the same
/// as the picture.
void expectEqual(const RaycastPicture& got, const SlowRaycast& slow, const RandomView& view, const std::string& name,
                 std::size_t& edges) {
  constexpr double kDepthError = 2e-7;  // single precision, relative
  const PixelRays rays(view.info);
  const double px = 0.01 / view.info.focalLength();
  for (std::uint32_t row = 0; row < got.height_px; ++row) {
    for (std::uint32_t column = 0; column < got.width_px; ++column) {
      const auto is_like = [&](const SlowSight& sight) {
        // A camera inside of several solids sees one of them, all at no distance.
        if (sight.depth_m == 0 && sight.body != RaycastPicture::kSky) {
          return depthAt(got, column, row) == 0 && bodyAt(got, column, row) != RaycastPicture::kSky;
        }
        return bodyAt(got, column, row) == sight.body &&
               std::abs(static_cast<double>(depthAt(got, column, row)) - sight.depth_m) <= kDepthError * sight.depth_m;
      };
      const auto has_color = [&](const SlowSight& sight) {
        if (sight.depth_m == 0 && sight.body != RaycastPicture::kSky) return true;  // from inside
        for (std::size_t i = 0; i < 3; ++i) {
          if (std::abs(colorAt(got, column, row)[i] - sight.color[i]) > 1) return false;
        }
        return true;
      };
      const auto sight = slow.at(column, row);
      if (is_like(sight) && has_color(sight)) continue;
      ++edges;
      const auto offset = rays.of(column, row);
      bool is_edge = false, is_edge_of_color = is_like(sight);
      double nearest = 1e9;
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          const auto beside = slow.along(offset.left + dx * px, offset.up + dy * px);
          is_edge_of_color |= has_color(beside);
          const double error = std::abs(static_cast<double>(depthAt(got, column, row)) - beside.depth_m) /
                               std::max(1e-9, beside.depth_m);
          if (beside.body == bodyAt(got, column, row)) nearest = std::min(nearest, error);
          // Within the change of depth over the hundredth of a pixel.
          is_edge |= beside.body == bodyAt(got, column, row) && (beside.depth_m == 0 || error < 0.05);
        }
      }
      ASSERT_TRUE((is_like(sight) || is_edge) && is_edge_of_color)
          << name << " column " << column << " row " << row << ": body " << bodyAt(got, column, row) << " at "
          << depthAt(got, column, row) << ", expected " << sight.body << " at " << sight.depth_m << "; nearest "
          << nearest << " colour " << int(colorAt(got, column, row)[0]) << " expected " << int(sight.color[0]);
    }
  }
}

void compareWithBruteForce(bool is_level, std::uint64_t seed_begin, std::uint64_t seeds) {
  std::size_t edges = 0, pixels = 0;
  for (std::uint64_t seed = seed_begin; seed < seed_begin + seeds; ++seed) {
    Rng rng(seed);
    SolidSpread spread{.area = {-6, 6, -6, 6}};
    const bool all_stand = rng.below(3) == 0;
    auto solids = randomSolids(rng, rng.below(40), spread);
    if (all_stand) {
      for (auto& solid : solids) solid.heights.z_min_m = 0;
    }
    Scene scene(solids, 4, spread.area);
    for (std::size_t i = 0; i < 4; ++i)
      scene.place(i, {randomCircle(rng, {.area = spread.area, .size_max_m = 0.6}), {0, 0.4}});
    scene.freeze();
    std::vector<SurfaceLook> looks;
    for (std::size_t i = 0; i < rng.below(44); ++i) {
      const auto level = [&] { return static_cast<std::uint8_t>(rng.below(256)); };
      looks.push_back({{level(), level(), level()}, rng.below(4) == 0});
    }
    FloorLook floor{.bounds = spread.area, .areas = {}};
    for (std::uint32_t i = rng.below(3); i > 0; --i) {
      floor.areas.push_back({randomOutline(rng, spread), {static_cast<std::uint8_t>(rng.below(256)), 0, 0}});
    }
    const SeenScene seen{scene, looks, floor};
    const BodyId owner = scene.movingBody(0);
    for (int i = 0; i < 4; ++i) {
      const RandomView view = randomView(rng, is_level, spread.area);
      const RaycastCamera camera(view.info, view.robot_from_camera, view.options);
      RaycastPicture picture;
      camera.take(seen, view.world_from_robot, owner, picture);
      forEachVectorWidth([&](VectorWidth width) {
        RaycastPicture other;
        camera.take(seen, view.world_from_robot, owner, other);
        ASSERT_EQ(other.rgb, picture.rgb) << nameOf(width);
        ASSERT_EQ(other.depth_m, picture.depth_m) << nameOf(width);
        ASSERT_EQ(other.body, picture.body) << nameOf(width);
      });
      const SlowRaycast slow(view.info, view.robot_from_camera, view.options.range_max_m, seen, view.world_from_robot,
                             owner);
      ASSERT_NO_FATAL_FAILURE(
          expectEqual(picture, slow, view, "seed " + std::to_string(seed) + " view " + std::to_string(i), edges));
      pixels += picture.body.size();
    }
  }
  EXPECT_LT(edges, pixels / 1000) << "few pixels may lie on edges";
}

TEST(RaycastCamera, TakesThePicturesOfBruteForceWithALevelCamera) { compareWithBruteForce(true, 1, 60); }
TEST(RaycastCamera, TakesThePicturesOfBruteForceInAnyDirectionAndWithALens) { compareWithBruteForce(false, 1001, 60); }

}  // namespace
}  // namespace robosim
