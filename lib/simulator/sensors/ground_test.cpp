#include "sensors/ground.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/random.h"
#include "sensors/testing/featured_scene.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr std::array<float, 3> kBlack{0, 0, 0}, kRed{1, 0, 0};

TEST(Ground, ReadsTheLumaOfTheAreaBelowEachPointAndWhiteBesideIt) {
  const auto sensor = sensorFrom("<ground><at x_m='0.1'/><at x_m='-0.1'/><at y_m='0.1'/></ground>");
  FeaturedScene scene;
  // The robot at (1, 2) faces +y: its points are (1, 2.1), (1, 1.9) and (0.9, 2).
  scene.robots = {{1, 2, M_PI / 2}};
  scene.objects = {coloured(boxBody({1, 2.55, 0}, 2, 1, -0.01, 0), kBlack),
                   coloured(pillarBody(0.9, 2, 0.02, -0.01, 0), kRed)};
  const auto grey = scene.values(*sensor);
  ASSERT_EQ(grey.size(), 3u);
  EXPECT_EQ(grey[0], 0);
  EXPECT_EQ(grey[1], 1);
  EXPECT_NEAR(grey[2], 0.299, 1e-6);
  EXPECT_EQ(sensor->info().quantities[2].name, "grey_3");
}

TEST(Ground, ReadsTheLastOfSeveralAreasAndNoObjectAboveTheFloor) {
  const auto sensor = sensorFrom("<ground><at/></ground>");
  FeaturedScene scene;
  scene.objects = {coloured(pillarBody(0, 0, 2, -0.01, 0), kBlack), coloured(pillarBody(0, 0, 1, -0.01, 0), kRed),
                   coloured(pillarBody(0, 0, 0.5, -0.01, 0.01), kBlack)};
  EXPECT_NEAR(scene.values(*sensor)[0], 0.299, 1e-6);
  std::swap(scene.objects[0], scene.objects[1]);
  EXPECT_EQ(scene.values(*sensor)[0], 0);
}

TEST(Ground, ReadsAPictureOnTheFloorBelowTheAreas) {
  // Two columns and one row of 0.5 m, of which the right one is painted, from (1, 1) upwards: it is turned by 90°.
  WorldMap map;
  map.height_m = 0;
  map.color = kBlack;
  map.world_from_map = {1, 1, M_PI / 2};
  map.plan.columns = 2;
  map.plan.rows = 1;
  map.plan.cell_m = 0.5;
  map.plan.occupied = {{.column = 1}};
  const auto sensor = sensorFrom("<ground><at/></ground>");
  FeaturedScene scene;
  scene.pictures = floorPicturesOf({map});
  const auto at = [&](double x, double y) {
    scene.robots = {{x, y, 0.3}};
    return scene.values(*sensor)[0];
  };
  EXPECT_EQ(at(0.75, 1.25), 1) << "the left cell";
  EXPECT_EQ(at(0.75, 1.75), 0);
  EXPECT_EQ(at(0.75, 2.01), 1) << "beside the picture";
  EXPECT_EQ(at(0.49, 1.75), 1);
  scene.objects = {coloured(pillarBody(0.75, 1.75, 0.1, -0.01, 0), kRed)};
  EXPECT_NEAR(at(0.75, 1.75), 0.299, 1e-6);
  map.height_m = 1;
  EXPECT_TRUE(floorPicturesOf({map}).empty()) << "walls";
}

TEST(Ground, ReadsTheBoxesOfAMapOnTheFloor) {
  // A box of 1 m by 0.2 m, turned by 90° with the map: its middle is at (1, 3), from y = 2.5 to 3.5.
  WorldMap map;
  map.height_m = 0;
  map.color = kBlack;
  map.world_from_map = {1, 1, M_PI / 2};
  map.plan.boxes = {{{2, 0, 0}, 1, 0.2}};
  const auto sensor = sensorFrom("<ground><at/></ground>");
  FeaturedScene scene;
  scene.pictures = floorPicturesOf({map});
  const auto at = [&](double x, double y) {
    scene.robots = {{x, y, 0}};
    return scene.values(*sensor)[0];
  };
  EXPECT_EQ(at(1.05, 3.4), 0);
  EXPECT_EQ(at(1.2, 3), 1);
  EXPECT_EQ(at(1, 3.6), 1);
}

TEST(Ground, ReadsWhatASearchOfAllAreasFinds) {
  Rng rng(3);
  const auto sensor = sensorFrom("<ground><ring count='8' radius_m='0.15'/></ground>");
  int painted = 0;
  for (int round = 0; round < 200; ++round) {
    FeaturedScene scene;
    scene.robots = {{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-3, 3)}};
    for (int i = 0; i < 6; ++i) {
      const mrpt::math::TPose2D pose(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-3, 3));
      const auto grey = static_cast<float>(rng.uniform());
      const Body body = i % 2 == 0 ? boxBody(pose, rng.uniform(0.1, 1), rng.uniform(0.1, 1), -0.01, 0)
                                   : pillarBody(pose.x, pose.y, rng.uniform(0.1, 0.6), -0.01, 0);
      scene.objects.push_back(coloured(body, {grey, grey, grey}));
    }
    const auto measured = scene.values(*sensor);
    for (int i = 0; i < 8; ++i) {
      const double direction = 2 * M_PI * i / 8;
      const auto point =
          scene.robots[0].composePoint(mrpt::math::TPoint2D(0.15 * std::cos(direction), 0.15 * std::sin(direction)));
      double expected = 1;
      for (const Body& area : scene.objects) {
        const auto in_area = area.world_from_body.inverseComposePoint(point);
        const auto* disc = std::get_if<Cylinder>(&area.shape);
        const bool is_on = disc ? in_area.norm() <= disc->radius_m
                                : std::abs(in_area.x) <= std::get<Cube>(area.shape).length_m / 2 &&
                                      std::abs(in_area.y) <= std::get<Cube>(area.shape).width_m / 2;
        if (is_on) expected = static_cast<double>(area.color[0]);
      }
      EXPECT_NEAR(measured[static_cast<std::size_t>(i)], expected, 1e-6) << "round " << round << ", point " << i;
      painted += expected < 1;
    }
  }
  EXPECT_GT(painted, 400);
}

TEST(Ground, NoiseHasTheGivenDeviationAndStaysInTheRange) {
  const auto sensor = sensorFrom("<ground><at/><noise std='0.1'/></ground>");
  EXPECT_TRUE(sensor->isNoisy());
  FeaturedScene scene;
  const auto spread = [&](float grey) {
    scene.objects = {coloured(pillarBody(0, 0, 1, -0.01, 0), {grey, grey, grey})};
    constexpr int kSamples = 4000;
    double squares = 0;
    for (int i = 0; i < kSamples; ++i) {
      ++scene.step;
      const double read = scene.values(*sensor)[0];
      EXPECT_GE(read, 0);
      EXPECT_LE(read, 1);
      squares += std::pow(read - static_cast<double>(grey), 2);
    }
    return std::sqrt(squares / kSamples);
  };
  // The standard error of a deviation is 1/89 of it. The bound is four of them.
  EXPECT_NEAR(spread(0.5f), 0.1, 4 * 0.1 / 89);
  EXPECT_NEAR(spread(0), 0.1 / std::sqrt(2), 0.01) << "half of the errors are cut off";
}

TEST(Ground, NeedsAPlace) { EXPECT_THROW(sensorFrom("<ground/>"), ConfigError); }

}  // namespace
}  // namespace robosim
